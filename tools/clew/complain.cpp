// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "clew/commands.hpp"

namespace clew::tools {

int complain(const core::Error& error, int status) {
  std::fprintf(stderr, "clew: %s\n", error.text().c_str());
  return status;
}

}  // namespace clew::tools

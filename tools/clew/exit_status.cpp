// SPDX-License-Identifier: Apache-2.0
#include "clew/exit_status.hpp"

#include <cstdio>

namespace clew::tools {

int complain(const core::Error& error, int status) {
  std::fprintf(stderr, "clew: %s\n", error.text().c_str());
  return status;
}

}  // namespace clew::tools

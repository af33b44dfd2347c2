// SPDX-License-Identifier: Apache-2.0
#include "clew/exit_status.hpp"

#include <cstdio>

#include "log/log.hpp"

namespace clew::tools {

int complain(const core::Error& error, int status) {
  logs::complain(error.text());
  return status;
}

}  // namespace clew::tools

// SPDX-License-Identifier: Apache-2.0
#include "core/check.hpp"

#include <cstdio>

#include "core/process_end.hpp"

namespace clew::core {

void check_failed(const char* condition, const char* file, int line, const std::string& what) {
  std::fprintf(stderr, "clew: internal error at %s:%d: %s does not hold: %s\n", file, line,
               condition, what.c_str());
  abort_process();
}

}  // namespace clew::core

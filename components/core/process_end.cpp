// SPDX-License-Identifier: Apache-2.0
#include "core/process_end.hpp"

#include <cstdlib>

#ifdef CLEW_COVERAGE
extern "C" {
#include <gcov.h>
}
#endif

namespace clew::core {
namespace {

void write_coverage() {
#ifdef CLEW_COVERAGE
  __gcov_dump();
#endif
}

}  // namespace

void end_at_once(int status) {
  write_coverage();
  std::_Exit(status);
}

void abort_process() {
  write_coverage();
  std::abort();
}

}  // namespace clew::core

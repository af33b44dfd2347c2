// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace clew::core {

/// Prints `what` with its place to stderr and aborts: the answer to a mistake of our own.
[[noreturn]] void check_failed(const char* condition, const char* file, int line,
                               const std::string& what);

}  // namespace clew::core

/// Always-on check of an invariant of our own code; `what` is a string with the values involved and
/// is built only on failure. Bad input is never answered with this, but with core::Result.
#define CLEW_CHECK(condition, what)                                       \
  do {                                                                    \
    if (!(condition)) {                                                   \
      ::clew::core::check_failed(#condition, __FILE__, __LINE__, (what)); \
    }                                                                     \
  } while (false)

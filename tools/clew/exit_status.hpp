// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/result.hpp"

namespace clew::tools {

inline constexpr int kExitGood = 0;
inline constexpr int kExitFailed = 1;
inline constexpr int kExitBadInput = 2;
inline constexpr int kExitTimeout = 3;
inline constexpr int kExitCollided = 4;
inline constexpr int kExitUnreachable = 5;
inline constexpr int kExitInterrupted = 130;

/// Prints an error as `clew: file:line: message` and returns `status`.
int complain(const core::Error& error, int status = kExitBadInput);

}  // namespace clew::tools

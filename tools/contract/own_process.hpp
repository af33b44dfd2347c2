// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "core/result.hpp"

namespace clew::contract {

/// Calls `work` in a process of its own and returns what it says. A crash and a time out are errors
/// of it, too, and do not touch the caller.
core::Result<void> in_own_process(const std::function<core::Result<void>()>& work,
                                  unsigned timeout_s);

}  // namespace clew::contract

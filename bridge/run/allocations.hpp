// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace clew::bridge {

/// How often this thread has allocated with `new` so far. A sanitizer's build counts none: its own
/// `new` is in force there.
std::uint64_t allocation_count();

}  // namespace clew::bridge

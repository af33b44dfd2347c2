// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

// A sanitizer has a `new` of its own, which must stay in force. GCC tells of each in a name of its
// own, clang in what it calls a feature.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define CLEW_SANITIZER_HAS_NEW 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || \
    __has_feature(memory_sanitizer)
#define CLEW_SANITIZER_HAS_NEW 1
#endif
#endif

namespace clew::bridge {

/// Of this thread. A program whose own `new` counts here adds to it (`tools/clew/counted_new.cpp`):
/// a library must not replace the `new` of the programs that use it.
inline thread_local std::uint64_t allocations_of_thread = 0;

/// How often this thread has allocated with `new` so far. Stays 0 in a program whose `new` does not
/// count. `new` of types that ask for more than the usual alignment does not count.
inline std::uint64_t allocation_count() { return allocations_of_thread; }

}  // namespace clew::bridge

// SPDX-License-Identifier: Apache-2.0
#include "run/allocations.hpp"

#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

thread_local std::uint64_t count = 0;

}  // namespace

namespace clew::bridge {

std::uint64_t allocation_count() { return count; }

}  // namespace clew::bridge

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

// The standard's other forms call these two, or pair with this delete: all end in malloc and free,
// as the library's own do, so that it does not matter who allocates and who frees.
void* operator new(std::size_t size) {
  ++count;
  while (true) {
    if (void* const memory = std::malloc(size == 0 ? 1 : size)) return memory;
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
  }
}

void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

#endif

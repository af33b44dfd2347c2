// SPDX-License-Identifier: Apache-2.0
// The program's own `new`, for `clew run --profile`: it counts, which costs one addition to a
// number of the thread. It belongs to the program and to no library: a user's program keeps its
// own.
#include <cstddef>
#include <cstdlib>
#include <new>

#include "run/allocations.hpp"

#ifndef CLEW_SANITIZER_HAS_NEW

// The arrays' and the nothrow forms call these, or pair with this delete. The forms for types of a
// greater alignment do not: they stay the library's, and do not count. All end in malloc and free,
// as the library's own do, so that it does not matter who allocates and who frees.
void* operator new(std::size_t size) {
  ++clew::bridge::allocations_of_thread;
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

// SPDX-License-Identifier: Apache-2.0
#include "clew/stack_limit.hpp"

#include <fmt/format.h>
#include <pthread.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstddef>

namespace clew::tools {
namespace {

constexpr std::size_t kStackBytes = std::size_t{8} << 20;
// The first thread has overrun 64 KiB, and never 128 KiB.
constexpr std::size_t kLeastBytes = std::size_t{256} << 10;

}  // namespace

core::Result<void> raise_small_stacks() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= kStackBytes) return {};
  if (limit.rlim_max < kLeastBytes) {
    return core::Error{fmt::format(
        "the hard limit of the stack is {} KiB; allowed: at least {} KiB ('ulimit -H -s' shows it)",
        limit.rlim_max >> 10, kLeastBytes >> 10)};
  }
  limit.rlim_cur = std::min<rlim_t>(kStackBytes, limit.rlim_max);
  ::setrlimit(RLIMIT_STACK, &limit);
  pthread_attr_t attributes;
  if (::pthread_attr_init(&attributes) != 0) return {};
  if (::pthread_attr_setstacksize(&attributes, kStackBytes) == 0) {
    ::pthread_setattr_default_np(&attributes);
  }
  ::pthread_attr_destroy(&attributes);
  return {};
}

}  // namespace clew::tools

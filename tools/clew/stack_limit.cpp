// SPDX-License-Identifier: Apache-2.0
#include "clew/stack_limit.hpp"

#include <pthread.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstddef>

namespace clew::tools {
namespace {

constexpr std::size_t kStackBytes = std::size_t{8} << 20;

}  // namespace

void raise_small_stacks() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= kStackBytes) return;
  limit.rlim_cur = std::min<rlim_t>(kStackBytes, limit.rlim_max);
  ::setrlimit(RLIMIT_STACK, &limit);
  pthread_attr_t attributes;
  if (::pthread_attr_init(&attributes) != 0) return;
  if (::pthread_attr_setstacksize(&attributes, kStackBytes) == 0) {
    ::pthread_setattr_default_np(&attributes);
  }
  ::pthread_attr_destroy(&attributes);
}

}  // namespace clew::tools

// SPDX-License-Identifier: Apache-2.0
#include "component/busy_thread.hpp"

#include <pthread.h>

namespace clew::bridge {
namespace {

clockid_t clock_of_this_thread() {
  clockid_t clock = CLOCK_REALTIME;
  ::pthread_getcpuclockid(::pthread_self(), &clock);
  return clock;
}

}  // namespace

void BusyThread::begin() {
  thread_local const clockid_t own = clock_of_this_thread();
  clock_ = own;
}

std::uint64_t BusyThread::processor_ns() const {
  const clockid_t clock = clock_.load();
  timespec time{};
  // It fails for a thread that has ended since.
  if (clock == kNobody || ::clock_gettime(clock, &time) != 0) return 0;
  return static_cast<std::uint64_t>(time.tv_sec) * 1'000'000'000 +
         static_cast<std::uint64_t>(time.tv_nsec);
}

}  // namespace clew::bridge

// SPDX-License-Identifier: Apache-2.0
/// Waits that nobody lengthens by setting the wall clock back. Cyclone DDS 0.10 waits for its timed
/// events until a time of the wall clock. Set back by a minute while it waits, it is silent for a
/// minute: its lease ends for the others, in a mix of vendors for good. This program's
/// pthread_cond_timedwait takes the place of the C library's for every library that it loads.
#include "vendors/timed_wait.hpp"

#include <pthread.h>

#include <cerrno>
#include <cmath>
#include <cstdint>

namespace clew::bridge {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

double seconds_between(const timespec& from, const timespec& to) {
  return static_cast<double>(to.tv_sec) - static_cast<double>(from.tv_sec) +
         static_cast<double>(to.tv_nsec - from.tv_nsec) / static_cast<double>(kSecond_ns);
}

}  // namespace

timespec monotonic_deadline(const timespec& until, const timespec& wall_now,
                            const timespec& monotonic_now) {
  const bool of_wall_clock = std::fabs(seconds_between(wall_now, until)) <
                             std::fabs(seconds_between(monotonic_now, until));
  if (!of_wall_clock) return until;
  // Nearer to the wall clock than to the other, so no sum is beyond its type.
  timespec deadline{};
  deadline.tv_sec = monotonic_now.tv_sec + (until.tv_sec - wall_now.tv_sec);
  std::int64_t nanoseconds = monotonic_now.tv_nsec + (until.tv_nsec - wall_now.tv_nsec);
  while (nanoseconds < 0) {
    nanoseconds += kSecond_ns;
    --deadline.tv_sec;
  }
  deadline.tv_sec += nanoseconds / kSecond_ns;
  deadline.tv_nsec = nanoseconds % kSecond_ns;
  return deadline.tv_sec < 0 ? timespec{} : deadline;
}

}  // namespace clew::bridge

// NOLINTNEXTLINE(readability-identifier-naming): the C library's name
extern "C" __attribute__((visibility("default"))) int pthread_cond_timedwait(
    pthread_cond_t* condition, pthread_mutex_t* mutex, const timespec* until) {
  if (until->tv_nsec < 0 || until->tv_nsec >= clew::bridge::kSecond_ns) return EINVAL;
  timespec wall_now{};
  timespec monotonic_now{};
  ::clock_gettime(CLOCK_REALTIME, &wall_now);
  ::clock_gettime(CLOCK_MONOTONIC, &monotonic_now);
  const timespec deadline = clew::bridge::monotonic_deadline(*until, wall_now, monotonic_now);
  return ::pthread_cond_clockwait(condition, mutex, CLOCK_MONOTONIC, &deadline);
}

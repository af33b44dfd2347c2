// SPDX-License-Identifier: Apache-2.0
#include "vendors/timed_wait.hpp"

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <pthread.h>

#include <cerrno>
#include <limits>
#include <utility>

namespace clew::bridge {
namespace {

constexpr timespec kWallNow{1'764'350'000, 250'000'000};
constexpr timespec kMonotonicNow{5'000, 900'000'000};

std::pair<long, long> deadline(const timespec& until, const timespec& wall_now = kWallNow) {
  const timespec monotonic = monotonic_deadline(until, wall_now, kMonotonicNow);
  return {monotonic.tv_sec, monotonic.tv_nsec};
}

TEST(TimedWait, UntilATimeOfTheWallClockEndsAsManySecondsFromNow) {
  EXPECT_EQ(deadline({1'764'350'000, 450'000'000}), std::pair(5'001L, 100'000'000L));
  EXPECT_EQ(deadline({1'764'350'060, 250'000'000}), std::pair(5'060L, 900'000'000L));
}

TEST(TimedWait, UntilATimeThatIsOverEndsAtOnce) {
  EXPECT_EQ(deadline({1'764'349'999, 250'000'000}), std::pair(4'999L, 900'000'000L));
  EXPECT_EQ(deadline({1'764'340'000, 0}), std::pair(0L, 0L)) << "before the machine started";
  EXPECT_EQ(deadline({0, 0}), std::pair(0L, 0L));
}

TEST(TimedWait, UntilATimeOfTheMonotonicClockStays) {
  EXPECT_EQ(deadline({5'001, 0}), std::pair(5'001L, 0L));
  EXPECT_EQ(deadline({4'000, 7}), std::pair(4'000L, 7L));
}

TEST(TimedWait, WithoutEndStaysSo) {
  constexpr long kNever = std::numeric_limits<long>::max();
  constexpr long kThousandYears_s = 31'557'600'000;

  EXPECT_GT(deadline({kNever, 0}).first, kThousandYears_s);
}

// A machine without a clock that outlives its power starts in 1970: then both show nearly the same.
TEST(TimedWait, EndsInTimeWhereBothClocksBeganTogether) {
  EXPECT_EQ(deadline({5'001, 500'000'000}, {5'001, 0}), std::pair(5'001L, 400'000'000L));
  EXPECT_EQ(deadline({5'000, 920'000'000}, {5'001, 0}), std::pair(5'000L, 920'000'000L))
      << "over by the wall clock, and for the moment between the two it waits";
}

TEST(TimedWait, IsWhatLibrariesFindThatAreLoaded) {
  EXPECT_EQ(::dlsym(RTLD_DEFAULT, "pthread_cond_timedwait"),
            reinterpret_cast<void*>(&::pthread_cond_timedwait));
  EXPECT_NE(::dlsym(RTLD_DEFAULT, "pthread_cond_timedwait"),
            ::dlsym(RTLD_NEXT, "pthread_cond_timedwait"));
}

TEST(TimedWait, TimesOutAndRefusesWhatIsNoTime) {
  pthread_cond_t condition = PTHREAD_COND_INITIALIZER;
  pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
  timespec until{};
  ::clock_gettime(CLOCK_REALTIME, &until);
  const timespec no_time{until.tv_sec, 1'000'000'000};

  ::pthread_mutex_lock(&mutex);
  EXPECT_EQ(::pthread_cond_timedwait(&condition, &mutex, &until), ETIMEDOUT);
  EXPECT_EQ(::pthread_cond_timedwait(&condition, &mutex, &no_time), EINVAL);
  ::pthread_mutex_unlock(&mutex);
}

}  // namespace
}  // namespace clew::bridge

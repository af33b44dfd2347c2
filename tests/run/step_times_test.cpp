// SPDX-License-Identifier: Apache-2.0
#include "run/step_times.hpp"

#include <gtest/gtest.h>

namespace clew::bridge {
namespace {

using std::chrono::microseconds;
using std::chrono::seconds;

TEST(RecentSteps, KnowNothingBeforeTheFirstStep) { EXPECT_EQ(RecentSteps().times().count, 0U); }

TEST(RecentSteps, TellMedianAndNinetyNinthPercentile) {
  RecentSteps steps;
  // 1 to 101 us, not in order: the 51st of them is 51 us, and the 100th is 100 us.
  for (int i = 0; i < 101; ++i) steps.add(microseconds(1 + (i * 37) % 101));

  const StepTimes times = steps.times();

  EXPECT_EQ(times.count, 101U);
  EXPECT_DOUBLE_EQ(times.p50_us, 51.0);
  EXPECT_DOUBLE_EQ(times.p99_us, 100.0);
}

TEST(RecentSteps, ForgetWhatIsLongAgo) {
  RecentSteps steps;
  for (int i = 0; i < 512; ++i) steps.add(seconds(1));
  for (int i = 0; i < 512; ++i) steps.add(microseconds(3));

  EXPECT_EQ(steps.times().count, 512U);
  EXPECT_DOUBLE_EQ(steps.times().p99_us, 3.0);
}

TEST(RecentSteps, TakeAnHourForTheLongestThatTheyCanHold) {
  RecentSteps steps;
  steps.add(seconds(3600));

  EXPECT_NEAR(steps.times().p50_us, 4.29e6, 1e4);
}

}  // namespace
}  // namespace clew::bridge

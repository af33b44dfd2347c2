// SPDX-License-Identifier: Apache-2.0
#include "run/run_profile.hpp"

#include <gtest/gtest.h>

namespace clew::bridge {
namespace {

using domain::Topic;
using std::chrono::microseconds;
using std::chrono::nanoseconds;

TEST(Durations, TellNothingWithoutAny) {
  const Durations none;

  EXPECT_EQ(none.count(), 0u);
  EXPECT_EQ(none.mean_us(), 0.0);
  EXPECT_EQ(none.quantile_us(0.99), 0.0);
}

TEST(Durations, TellQuantilesToOneThirtySecond) {
  Durations durations;
  for (int i = 1; i <= 1000; ++i) durations.add(microseconds(i));

  EXPECT_EQ(durations.mean_us(), 500.5);
  EXPECT_EQ(durations.greatest_us(), 1000.0);
  EXPECT_LE(durations.quantile_us(0.5), 500.0);
  EXPECT_GE(durations.quantile_us(0.5), 500.0 * 31.0 / 32.0);
  EXPECT_LE(durations.quantile_us(0.99), 990.0);
  EXPECT_GE(durations.quantile_us(0.99), 990.0 * 31.0 / 32.0);
}

TEST(Durations, KeepShortAndLongOnesApart) {
  for (const std::int64_t ns : {0L, 31L, 32L, 63L, 64L, 65L, 1L << 20, (1L << 62) + 1}) {
    Durations durations;
    durations.add(nanoseconds(ns));

    const double exact_us = static_cast<double>(ns) * 1e-3;
    EXPECT_LE(durations.quantile_us(0.5), exact_us) << ns;
    EXPECT_GE(durations.quantile_us(0.5), exact_us * 31.0 / 32.0) << ns;
  }
}

/// Two ticks: sense steps 3 and 5 us, its sample takes 1 us, drive steps 2 us.
RunProfile two_ticks() {
  RunProfile profile({{"sense", {Topic::kScan}}, {"drive", {Topic::kState}}});
  RunProfile::Clock::time_point now;
  for (const int step_us : {3, 5}) {
    profile.begin_tick(step_us == 3 ? 0 : 1, now);
    profile.begin_sample(Topic::kScan, now += microseconds(step_us));
    profile.end_sample(now += microseconds(1));
    profile.begin_sample(Topic::kState, now += microseconds(2));
    profile.end_sample(now);
    profile.end_tick(now);
    now += microseconds(100);  // between two ticks, which is nobody's
  }
  return profile;
}

TEST(RunProfile, TellsWhoSpentATick) {
  // Ticks take 6 and 8 us: 14 in all, of which sense has 8, the samples 2 and drive 4.
  EXPECT_EQ(two_ticks().table(),
            "us a tick          mean        p50        p99        max   share\n"
            "sense              4.00       2.94       4.99       5.00   57.1%\n"
            "drive              2.00       1.98       1.98       2.00   28.6%\n"
            "samples            1.00       0.99       0.99       1.00   14.3%\n"
            "tick               7.00       5.89       7.94       8.00  100.0%\n");
}

TEST(RunProfile, TellsTheStepsOfAComponent) {
  const StepTimes sense = two_ticks().step_times("sense");

  EXPECT_EQ(sense.count, 2U);
  // As in the table, which rounds them.
  EXPECT_NEAR(sense.p50_us, 2.94, 0.01);
  EXPECT_NEAR(sense.p99_us, 4.99, 0.01);
  EXPECT_EQ(two_ticks().step_times("nobody").count, 0U);
}

TEST(RunProfile, TracesEachStepAtItsTime) {
  const std::string trace = two_ticks().trace();

  EXPECT_NE(trace.find("{\"name\":\"sense\",\"ph\":\"X\",\"pid\":1,\"tid\":1,\"ts\":0.000,"
                       "\"dur\":3.000,\"args\":{\"tick\":0}}"),
            std::string::npos);
  EXPECT_NE(trace.find("{\"name\":\"tick\",\"ph\":\"X\",\"pid\":1,\"tid\":1,\"ts\":106.000,"
                       "\"dur\":8.000,\"args\":{\"tick\":1}}"),
            std::string::npos);
}

}  // namespace
}  // namespace clew::bridge

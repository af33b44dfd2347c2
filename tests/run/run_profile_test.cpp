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

/// A clock that is set by hand, and a count of allocations.
class Hand {
 public:
  const RunProfile::Moment& now() const { return moment_; }
  const RunProfile::Moment& pass(int time_us, std::uint64_t allocations = 0) {
    moment_.at += microseconds(time_us);
    moment_.allocations += allocations;
    return moment_;
  }

 private:
  RunProfile::Moment moment_;
};

/// Two ticks: sense steps 3 and 5 us, the second time with 2 us and 3 allocations for rays; its
/// sample takes 1 us and an allocation, drive steps 2 us.
RunProfile two_ticks() {
  RunProfile profile({{"sense", {Topic::kScan}}, {"drive", {Topic::kState}}});
  Hand hand;
  for (const int rays_us : {0, 2}) {
    profile.begin_tick(rays_us == 0 ? 0 : 1, hand.now());
    hand.pass(2);
    if (rays_us > 0) {
      profile.begin_part("rays", hand.now());
      profile.end_part(hand.pass(rays_us, 3));
    }
    profile.begin_sample(Topic::kScan, hand.pass(1));
    profile.end_sample(hand.pass(1, 1));
    profile.begin_sample(Topic::kState, hand.pass(2));
    profile.end_sample(hand.now());
    profile.end_tick(hand.now());
    hand.pass(100, 50);  // between two ticks, which is nobody's
  }
  return profile;
}

TEST(RunProfile, TellsWhoSpentATick) {
  // Ticks take 6 and 8 us: 14 in all, of which sense has 8, with 2 of rays, the samples 2 and
  // drive 4. Sense allocates 3 times, all for rays, and the samples twice.
  EXPECT_EQ(
      two_ticks().table(),
      "us a tick                  mean        p50        p99        max   share allocations\n"
      "sense                      4.00       2.94       4.99       5.00   57.1%        1.50\n"
      "  rays                     1.00       0.00       1.98       2.00   14.3%        1.50\n"
      "drive                      2.00       1.98       1.98       2.00   28.6%        0.00\n"
      "samples                    1.00       0.99       0.99       1.00   14.3%        1.00\n"
      "tick                       7.00       5.89       7.94       8.00  100.0%        2.50\n");
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
  // The second tick begins at 106 us, its rays 2 us later.
  EXPECT_NE(trace.find("{\"name\":\"rays\",\"ph\":\"X\",\"pid\":1,\"tid\":1,\"ts\":108.000,"
                       "\"dur\":2.000,\"args\":{\"tick\":1}}"),
            std::string::npos);
}

}  // namespace
}  // namespace clew::bridge

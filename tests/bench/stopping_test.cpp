// SPDX-License-Identifier: Apache-2.0
#include "bench/stopping.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "bench/report.hpp"

namespace clew::bench {
namespace {

BenchPlan plan_of(const std::vector<std::string>& families, std::size_t seeds) {
  BenchPlan plan;
  plan.suite = "test";
  plan.configuration["max_ticks"] = "100";
  for (std::size_t i = 0; i < families.size(); ++i) {
    plan.worlds.push_back({families[i], std::to_string(i), {}});
  }
  for (std::size_t i = 0; i < seeds; ++i) plan.seeds.push_back(i + 1);
  plan.variants = {{"g", {}, {}}};
  return plan;
}

std::vector<std::string> worlds_of(const BenchPlan& plan) {
  std::vector<std::string> names;
  for (const BenchWorld& world : plan.worlds) names.push_back(world.name);
  return names;
}

TEST(AnytimeInterval, HoldsWhatItsEquationSays) {
  // Two of two: 3 p^2 > 0.05, so p > sqrt(0.05 / 3).
  EXPECT_NEAR(anytime_interval(2, 2).low, std::sqrt(0.05 / 3.0), 1e-12);
  EXPECT_EQ(anytime_interval(2, 2).high, 1.0);
  // None of one: 2 (1 - p) > 0.05.
  EXPECT_NEAR(anytime_interval(0, 1).high, 0.975, 1e-12);
  EXPECT_EQ(anytime_interval(0, 1).low, 0.0);
  // One of two: 6 p (1 - p) > 0.05, symmetric.
  const double low = 0.5 - std::sqrt(0.25 - 0.05 / 6.0);
  EXPECT_NEAR(anytime_interval(1, 2).low, low, 1e-12);
  EXPECT_NEAR(anytime_interval(1, 2).high, 1.0 - low, 1e-12);
  EXPECT_EQ(anytime_interval(0, 0).low, 0.0);
  EXPECT_EQ(anytime_interval(0, 0).high, 1.0);
}

TEST(AnytimeInterval, IsWiderThanWilsonsAndNarrowsWithTrials) {
  double width = 1.0;
  for (const std::size_t trials : {10u, 100u, 1000u, 10000u, 1000000u}) {
    const std::size_t successes = trials * 9 / 10;
    const Interval anytime = anytime_interval(successes, trials);
    const Interval wilson = wilson_interval(successes, trials);

    EXPECT_LE(anytime.low, wilson.low) << trials;
    EXPECT_GE(anytime.high, wilson.high) << trials;
    EXPECT_LT(anytime.high - anytime.low, width) << trials;
    width = anytime.high - anytime.low;
  }
}

/// How many of `paths` sequences of coins have an interval somewhere that does not hold the truth.
template <typename IntervalOf>
int misses(double truth, int paths, std::size_t trials, const IntervalOf& interval_of) {
  std::mt19937_64 dice(7);
  int missed = 0;
  for (int path = 0; path < paths; ++path) {
    std::size_t successes = 0;
    bool holds = true;
    for (std::size_t n = 1; n <= trials; ++n) {
      const double drawn = static_cast<double>(dice() >> 11) * 0x1p-53;
      successes += drawn < truth ? 1 : 0;
      const Interval interval = interval_of(successes, n);
      holds = holds && interval.low <= truth && truth <= interval.high;
    }
    missed += holds ? 0 : 1;
  }
  return missed;
}

TEST(AnytimeInterval, HoldsTheTruthAtEveryLookUnlikeWilsons) {
  constexpr int kPaths = 200;
  for (const double truth : {0.5, 0.9}) {
    // At most 5 %, which is 10, and three standard deviations of that.
    EXPECT_LE(misses(truth, kPaths, 200, anytime_interval), 19) << truth;
    EXPECT_GE(misses(truth, kPaths, 200, wilson_interval), 30) << truth;
  }
}

TEST(Batches, GoBySeedsWhereThereAreSeveral) {
  const BenchPlan plan = plan_of({"a", "a", "b"}, 5);
  const Batches batches(plan);

  EXPECT_EQ(batches.count(), 5u);
  EXPECT_EQ(batches.first(2).seeds, (std::vector<std::uint64_t>{1, 2}));
  EXPECT_EQ(batches.first(2).worlds.size(), 3u);
  EXPECT_EQ(batches.first(2).configuration, plan.configuration);
}

TEST(Batches, TakeAWorldOfEachFamilyWhereThereIsOneSeed) {
  const BenchPlan plan = plan_of({"a", "a", "a", "b", "c", "c"}, 1);
  const Batches batches(plan);

  EXPECT_EQ(batches.count(), 3u);
  EXPECT_EQ(worlds_of(batches.first(1)), (std::vector<std::string>{"0", "3", "4"}));
  EXPECT_EQ(worlds_of(batches.first(2)), (std::vector<std::string>{"0", "1", "3", "4", "5"}));
  EXPECT_EQ(worlds_of(batches.first(3)), worlds_of(plan));
}

TEST(Batches, AreLookedAtAfterATenthMoreEachTime) {
  EXPECT_EQ(Batches::next_look(1), 2u);
  EXPECT_EQ(Batches::next_look(9), 10u);
  EXPECT_EQ(Batches::next_look(10), 12u);
  EXPECT_EQ(Batches::next_look(1000), 1101u);
}

/// Runs of two graphs with 40 seeds; the second is known less well.
class StoppedBench : public testing::Test {
 protected:
  StoppedBench() : plan_(plan_of({"a"}, 40)) {
    plan_.variants = {{"sure", {}, {}}, {"unsure", {}, {}}};
    plan_.stopping = Stopping{0.2, 40, 100};
    results_.plan = &plan_;
    for (const char* graph : {"sure", "unsure"}) {
      for (const std::uint64_t seed : plan_.seeds) {
        RunResult run;
        run.key = {graph, "", "0", seed};
        run.family = "a";
        run.hash = graph + std::to_string(seed);
        run.solvable = true;
        run.success = graph == std::string("sure") || seed % 2 == 0;
        results_.runs.push_back(run);
      }
    }
  }

  BenchPlan plan_;
  BenchResults results_;
};

TEST_F(StoppedBench, IsAsWellKnownAsItsLeastKnownGraph) {
  const Interval interval = anytime_interval(20, 40);

  EXPECT_DOUBLE_EQ(widest(results_), interval.high - interval.low);
  // A run of which nobody knows whether it is a success is no trial.
  results_.runs[0].success = std::nullopt;
  EXPECT_EQ(sequential_share(results_, 0).trials, 39u);
  // Nor is a copy.
  results_.runs[2].hash = results_.runs[1].hash;
  EXPECT_EQ(sequential_share(results_, 0).trials, 38u);
}

TEST_F(StoppedBench, SaysInItsReportWhatHolds) {
  const Report report = make_report(results_, {});

  EXPECT_EQ(report.tables[1].title, "Success, looked at while it came in");
  EXPECT_EQ(report.tables[1].rows[1][1].substr(0, 14), "20/40 50.00 % ");
  const Interval interval = anytime_interval(20, 40);
  EXPECT_EQ(report.remarks.back(),
            "Not known well enough after 40 of 100 batches: the widest interval of a graph's "
            "success is " +
                fmt::format("{:.4f}", interval.high - interval.low) + ", 0.2000 was asked for.");
  plan_.stopping->width = 0.5;
  EXPECT_EQ(make_report(results_, {}).remarks.back().substr(0, 29),
            "Ended after 40 of 100 batches");
}

}  // namespace
}  // namespace clew::bench

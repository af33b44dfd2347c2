// SPDX-License-Identifier: Apache-2.0
#include "bench/barn.hpp"

#include <gtest/gtest.h>

#include "bench/bench_plan.hpp"

namespace clew::bench {
namespace {

// BARN's own path of 12 m: 6 s at 2 m/s.
constexpr double kPath_m = 12.0;

double score(double time_s) { return barn_score(true, time_s, kPath_m).score; }
double score_2022(double time_s) { return barn_score(true, time_s, kPath_m).score_2022; }

TEST(BarnScore, IsTheOptimalTimeOverTheTimeTakenWithinBounds) {
  EXPECT_EQ(barn_score(true, 20.0, kPath_m).optimal_time_s, 6.0);
  EXPECT_EQ(score(24.0), 6.0 / 24.0);
  // No more than for twice the optimal time, no less than for eight times.
  EXPECT_EQ(score(12.0), 0.5);
  EXPECT_EQ(score(5.0), 0.5);
  EXPECT_EQ(score(48.0), 0.125);
  EXPECT_EQ(score(99.9), 0.125);
}

TEST(BarnScore, OfTheYear2022HasFourTimesTheOptimumAsItsBest) {
  EXPECT_EQ(score_2022(30.0), 6.0 / 30.0);
  EXPECT_EQ(score_2022(24.0), 0.25);
  EXPECT_EQ(score_2022(12.0), 0.25);
  EXPECT_EQ(score_2022(99.9), 0.125);
}

TEST(BarnScore, IsNothingWithoutArrivalInTime) {
  EXPECT_EQ(barn_score(false, 20.0, kPath_m).score, 0.0);
  EXPECT_EQ(score(100.0), 0.0);
  EXPECT_FALSE(barn_score(true, 100.0, kPath_m).arrived);
  EXPECT_TRUE(barn_score(true, 99.9, kPath_m).arrived);
}

TEST(BarnTable, HasARowAVariantWithMeansOfItsRuns) {
  BenchPlan plan;
  plan.variants = {{"planner", {}, {}}, {"default", {}, {}}};
  plan.worlds = {{"barn", "barn-1", {}}, {"barn", "barn-2", {}}};
  plan.seeds = {1};
  BenchResults results{&plan, std::vector<RunResult>(4)};
  const double times_s[] = {12.0, 24.0, 24.0, 24.0};
  for (std::size_t i = 0; i < 4; ++i) {
    RunResult& run = results.runs[i];
    run.key.world = plan.worlds[i % 2].name;
    run.hash = std::to_string(i);
    run.collisions = i == 3 ? 1 : 0;
    run.barn = barn_score(i != 3, times_s[i], kPath_m);
  }

  const Table table = barn_table(results);

  ASSERT_EQ(table.rows.size(), 2u);
  // (0.5 + 0.25) / 2 and (0.25 + 0.25) / 2; (0.25 + 0) / 2.
  EXPECT_EQ(table.rows[0],
            (std::vector<std::string>{"planner", "2", "0.3750", "0.2500", share_text(2, 2), "0"}));
  EXPECT_EQ(table.rows[1],
            (std::vector<std::string>{"default", "2", "0.1250", "0.1250", share_text(1, 2), "1"}));
}

TEST(BarnTable, IsEmptyForOtherWorlds) {
  BenchPlan plan;
  plan.variants = {{"planner", {}, {}}};
  plan.worlds = {{"traps", "u-trap", {}}};
  plan.seeds = {1};
  const BenchResults results{&plan, std::vector<RunResult>(1)};

  EXPECT_TRUE(barn_table(results).rows.empty());
}

}  // namespace
}  // namespace clew::bench

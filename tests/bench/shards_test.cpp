// SPDX-License-Identifier: Apache-2.0
#include "bench/shards.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "bench/run_order.hpp"

namespace clew::bench {
namespace {

BenchPlan plan_of(std::size_t variants, std::size_t worlds, std::size_t seeds) {
  BenchPlan plan;
  for (std::size_t i = 0; i < variants; ++i) plan.variants.push_back({std::to_string(i), {}, {}});
  for (std::size_t i = 0; i < worlds; ++i) plan.worlds.push_back({"f", std::to_string(i), {}});
  for (std::size_t i = 0; i < seeds; ++i) plan.seeds.push_back(i);
  return plan;
}

struct Size {
  std::size_t variants, worlds, seeds, shards, workers;
};
constexpr Size kSizes[] = {{1, 1, 1, 1, 1},  {1, 1, 1, 3, 2},   {2, 3, 5, 4, 1},   {2, 12, 2, 4, 2},
                           {3, 40, 1, 7, 3}, {5, 2, 100, 8, 4}, {1, 1, 7, 1000, 1}};

TEST(Shards, HoldEveryRunExactlyOnce) {
  for (const Size& size : kSizes) {
    const BenchPlan plan = plan_of(size.variants, size.worlds, size.seeds);
    const Shards shards(plan, size.shards);
    const std::size_t runs = size.variants * size.seeds;
    std::vector<std::size_t> times(runs * size.worlds);

    for (std::size_t number = 1; number <= size.shards; ++number) {
      for (const Unit& unit : shards.units_of(number, size.workers)) {
        for (std::size_t run = unit.first; run < unit.end; ++run) {
          ++times[unit.world * runs + run];
          EXPECT_EQ(shards.of(unit.world, run), number);
        }
      }
    }

    EXPECT_EQ(std::count(times.begin(), times.end(), 1u),
              static_cast<std::ptrdiff_t>(times.size()));
  }
}

std::size_t runs_of(const Shards& shards, std::size_t number) {
  std::size_t runs = 0;
  for (const Unit& unit : shards.units_of(number, 1)) runs += unit.end - unit.first;
  return runs;
}

TEST(Shards, AreOfAboutOneSize) {
  // 12 worlds for 4 shards are too few to go by worlds; 2 worlds of 500 runs all the more.
  for (const Size& size : {Size{2, 12, 2, 4, 1}, Size{5, 2, 100, 8, 1}, Size{3, 400, 1, 7, 1}}) {
    const BenchPlan plan = plan_of(size.variants, size.worlds, size.seeds);
    const Shards shards(plan, size.shards);
    const double share = static_cast<double>(plan.runs()) / static_cast<double>(size.shards);

    for (std::size_t number = 1; number <= size.shards; ++number) {
      EXPECT_NEAR(static_cast<double>(runs_of(shards, number)) / share, 1.0, 0.25) << number;
    }
  }
}

TEST(Shards, KeepAWorldTogetherWhereThereAreEnough) {
  const BenchPlan plan = plan_of(3, 40, 2);
  const Shards shards(plan, 10);

  for (std::size_t world = 0; world < 40; ++world) {
    for (std::size_t run = 0; run < 6; ++run) EXPECT_EQ(shards.of(world, run), world % 10 + 1);
  }
}

TEST(Shards, CutUnitsForManyWorkersButNotBelowSixteenRuns) {
  const Shards large(plan_of(1, 1, 1000), 1);
  const Shards small(plan_of(1, 1, 20), 1);

  EXPECT_EQ(large.units_of(1, 1).size(), 1u);
  EXPECT_EQ(large.units_of(1, 8).size(), 32u);
  EXPECT_EQ(small.units_of(1, 8).size(), 1u);
}

TEST(Shard, IsReadFromIOfN) {
  const auto shard = read_shard("2/4");
  ASSERT_TRUE(shard.ok());
  EXPECT_EQ(shard->number, 2u);
  EXPECT_EQ(shard->count, 4u);
  EXPECT_EQ(shard->text(), "2/4");

  for (const char* text : {"", "2", "2/", "/4", "0/4", "5/4", "1/1001", "-1/4", "1/4x", " 1/4",
                           "1 /4", "1/0", "1.0/4", "99999999999999999999/4"}) {
    const auto refused = read_shard(text);
    ASSERT_FALSE(refused.ok()) << text;
    EXPECT_NE(refused.error().text().find("expected I/N"), std::string::npos);
  }
}

TEST(RunOrder, GoesByVariantThenWorldThenSeed) {
  BenchPlan plan = plan_of(3, 4, 5);
  plan.variants[2] = {"0", {{"sense", "laser"}}, {}};  // another value for the first graph
  const RunOrder order(plan);

  for (std::size_t index = 0; index < order.size(); ++index) {
    EXPECT_EQ(order.index_of(order.key_of(index)), index);
    const auto [world, run] = order.in_world(index);
    EXPECT_EQ(order.index_of(run / 5, world, run % 5), index);
  }
  EXPECT_EQ(run_text(order.key_of(59)), "0 [sense=laser] in 3, seed 4");
  EXPECT_FALSE(order.index_of(RunKey{"0", "", "4", 0}));
  EXPECT_FALSE(order.index_of(RunKey{"0", "sense=sonar", "3", 0}));
  EXPECT_FALSE(order.index_of(RunKey{"0", "", "3", 5}));
}

}  // namespace
}  // namespace clew::bench

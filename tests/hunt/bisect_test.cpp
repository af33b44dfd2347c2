// SPDX-License-Identifier: Apache-2.0
#include "hunt/bisect.hpp"

#include <gtest/gtest.h>

#include "stages/all.hpp"
#include "tests/source_path.hpp"

namespace clew::hunt {
namespace {

/// The graph of Krishna & Kalra in the U that it leaves, with these changes.
BisectSide side(const std::vector<std::string>& set, const std::vector<std::string>& with = {},
                const std::string& world = "u-trap") {
  runtime::GraphOverrides overrides;
  overrides.set = set;
  overrides.with = with;
  overrides.world = world;
  overrides.max_ticks = 400;
  auto plan =
      runtime::prepare_run("krishna_kalra", overrides,
                           runtime::ConfigPath({tests::source_path("configs")}), stages::all());
  if (!plan.ok()) ADD_FAILURE() << plan.error().text();
  return {"side", std::move(plan->bundle)};
}

BisectEnd bisected(const BisectSide& a, const BisectSide& b,
                   const std::optional<Property>& property = {}) {
  auto end = bisect(a, b, property, stages::all());
  if (!end.ok()) ADD_FAILURE() << end.error().text();
  return std::move(end).value();
}

TEST(Bisect, FindsTheOneOfManySettingsThatMakesTheRunFail) {
  const BisectSide good = side({});
  // Without recovery it stays in the trap; the others change little or nothing.
  const BisectSide bad =
      side({"control.guard_margin_m=0.06", "classify.capacity=16", "drive.safety_margin_m=0.006"},
           {"recover.detector=none"});

  const BisectEnd end = bisected(good, bad);

  EXPECT_EQ(end.outcome_a, "reached");
  EXPECT_EQ(end.outcome_b, "timeout");
  EXPECT_EQ(end.differences.size(), 4u);
  ASSERT_EQ(end.cause.size(), 1u);
  EXPECT_EQ(end.differences[end.cause[0]].name, "recover.detector");
  EXPECT_TRUE(end.differences[end.cause[0]].changes_verdict);
}

TEST(Bisect, SortsSettingsByTheTickAtWhichTheyMatter) {
  // The range of the sensor shows in the first scan; a margin only where the robot is near a wall;
  // the capacity of a memory that is never full, not at all.
  const BisectEnd end = bisected(
      side({}), side({"classify.capacity=64", "control.guard_margin_m=0.4", "sense.range_m=1.4"}));

  ASSERT_EQ(end.differences.size(), 3u);
  EXPECT_EQ(end.differences[0].name, "sense.range_m");
  ASSERT_TRUE(end.differences[0].first.has_value());
  EXPECT_EQ(end.differences[0].first->topic, domain::Topic::kScan);
  EXPECT_EQ(end.differences[1].name, "control.guard_margin_m");
  ASSERT_TRUE(end.differences[1].first.has_value());
  EXPECT_GT(end.differences[1].first->tick, end.differences[0].first->tick);
  EXPECT_FALSE(end.differences[2].first.has_value());
}

TEST(Bisect, TakesFilesAndPropertiesAsWell) {
  // The run in the U takes 247 ticks, that in the open field 58.
  const auto property = Property::parse("ticks < 200 or outcome == timeout", "p");
  ASSERT_TRUE(property.ok());

  const BisectEnd end =
      bisected(side({}), side({"classify.capacity=16"}, {}, "open-field"), *property);

  EXPECT_TRUE(end.verdicts_differ);
  ASSERT_EQ(end.cause.size(), 1u);
  EXPECT_EQ(end.differences[end.cause[0]].name, "world.yaml");
}

TEST(Bisect, OfARunWithItselfFindsNothing) {
  const BisectEnd end = bisected(side({}), side({}));

  EXPECT_TRUE(end.differences.empty());
  EXPECT_FALSE(end.verdicts_differ);
  EXPECT_TRUE(end.cause.empty());
}

}  // namespace
}  // namespace clew::hunt

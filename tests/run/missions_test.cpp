// SPDX-License-Identifier: Apache-2.0
#include "run/missions.hpp"

#include <gtest/gtest.h>

namespace clew::bridge {
namespace {

constexpr char kWorld[] =
    "format: clew-world/1\nname: room\nabout: \"A room.\"\nbounds: [0, 0, 9, 9]\nstart: [1, 1, 0]\n"
    "waypoints: [[2, 2]]\ntarget: [8, 8]\ntarget_radius: 0.3\n";

runtime::Bundle bundle(const std::string& graph) {
  return {{"world.yaml", kWorld}, {"graph.yaml", "format: clew-graph/1\n" + graph}};
}

domain::Intervention change(std::uint64_t tick, const std::string& text) {
  return {tick, tick, {text}, {}, {}};
}

TEST(Missions, AreThoseOfTheWorldFirst) {
  const auto missions = missions_of(bundle(""), {});

  ASSERT_TRUE(missions.ok()) << missions.error().text();
  ASSERT_EQ(missions->size(), 1U);
  ASSERT_EQ(missions->front().waypoints.size(), 2U);
  EXPECT_EQ(missions->front().waypoints[0].place, core::Vec2(2, 2));
  EXPECT_EQ(missions->front().waypoints[1].radius_m, 0.3);
}

TEST(Missions, OfAGraphGoBeforeThoseOfItsWorld) {
  const auto missions = missions_of(bundle("mission: [[3, 3, 0.5], [4, 4]]\n"), {});

  ASSERT_TRUE(missions.ok()) << missions.error().text();
  ASSERT_EQ(missions->front().waypoints.size(), 2U);
  EXPECT_EQ(missions->front().waypoints[0].radius_m, 0.5);
  EXPECT_EQ(missions->front().waypoints[1].place, core::Vec2(4, 4));
}

TEST(Missions, ChangeWithTheGoalAndWithNothingElse) {
  const auto missions = missions_of(
      bundle(""),
      {change(5, "recover.detector=none"), change(7, "goal=5,5/6,6,0.2"), change(9, "goal=none")});

  ASSERT_TRUE(missions.ok()) << missions.error().text();
  ASSERT_EQ(missions->size(), 3U);
  EXPECT_EQ((*missions)[1].tick, 7U);
  ASSERT_EQ((*missions)[1].waypoints.size(), 2U);
  EXPECT_EQ((*missions)[1].waypoints[1].radius_m, 0.2);
  EXPECT_EQ((*missions)[2].tick, 9U);
  EXPECT_TRUE((*missions)[2].waypoints.empty());
}

TEST(Missions, AreRefusedWithoutAWorld) {
  EXPECT_FALSE(missions_of({{"graph.yaml", "format: clew-graph/1\n"}}, {}).ok());
}

}  // namespace
}  // namespace clew::bridge

// SPDX-License-Identifier: Apache-2.0
#include "world/route.hpp"

#include <gtest/gtest.h>

namespace clew::world {
namespace {

const std::vector<Waypoint> kTour = {{{1.0, 0.0}, 0.2}, {{2.0, 0.0}, 0.5}, {{3.0, 4.0}, 0.5}};
const core::Pose2 kAtFirst{1.0, 0.2, 0.0};

std::string saved(const Route& route) {
  core::StateWriter writer;
  route.save(writer);
  return writer.take();
}

TEST(Route, PassesAPointFromItsRadiusOn) {
  Route route(kTour);

  route.pass({1.0, 0.201, 0.0});
  EXPECT_EQ(route.passed(), 0u);
  route.pass(kAtFirst);
  EXPECT_EQ(route.passed(), 1u);
  EXPECT_EQ(route.next().place, Vec2(2.0, 0.0));
}

TEST(Route, GoesOnWhereASavedOneWas) {
  Route route(kTour);
  route.pass(kAtFirst);
  Route other(kTour);
  const std::string state = saved(route);
  core::StateReader reader(state);

  other.load(reader);

  EXPECT_TRUE(reader.complete());
  EXPECT_EQ(other.passed(), 1u);
  EXPECT_EQ(saved(other), state);
}

TEST(Route, BeginsIfTheSavedOneWasAnother) {
  Route route(kTour);
  route.pass(kAtFirst);
  std::vector<Waypoint> wider = kTour;
  wider.back().radius_m = 0.6;
  Route other(wider);
  const std::string state = saved(route);
  core::StateReader reader(state);

  other.load(reader);

  EXPECT_TRUE(reader.complete());
  EXPECT_EQ(other.passed(), 0u);
}

/// As drive and plan wrote before there were way-points.
TEST(Route, WithNothingPassedWritesNothing) {
  Route route(kTour);
  route.pass(kAtFirst);
  core::StateReader nothing("");

  route.load(nothing);

  EXPECT_EQ(saved(Route(kTour)), "");
  EXPECT_TRUE(nothing.complete());
  EXPECT_EQ(route.passed(), 0u);
}

TEST(Route, RefusesAStateBeyondItsEnd) {
  Route passed(kTour);
  passed.pass(kAtFirst);
  std::string state = saved(passed);
  state[state.size() - 4] = 3;
  core::StateReader reader(state);
  Route route(kTour);

  route.load(reader);

  EXPECT_FALSE(reader.ok());
  EXPECT_EQ(reader.fault(), "'next' is no way-point of the mission, byte 20 of 20");
  EXPECT_EQ(route.passed(), 0u);
}

TEST(Route, OfNoPointsLeadsNowhereAndDoesNotEnd) {
  Route route({});

  route.pass({});

  EXPECT_TRUE(route.empty());
  EXPECT_FALSE(route.ends_at({}));
}

}  // namespace
}  // namespace clew::world

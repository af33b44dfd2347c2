// SPDX-License-Identifier: Apache-2.0
#include "hunt/world_edit.hpp"

#include <gtest/gtest.h>

#include "runtime/config_source.hpp"
#include "tests/source_path.hpp"

namespace clew::hunt {
namespace {

constexpr double kRadius_m = 0.15;
constexpr char kRoom[] = R"(format: clew-world/1
name: room
about: "a \"room\"\x07\n"
bounds: [0, 0, 10, 10]
walls: [[6, 0, 6, 7]]
polygons: [[[1, 8], [2, 8], [1.5, 9]]]
circles: [[3, 5, 0.3]]
moving: [{circle: [8, 8, 0.2], path: [[0, 8, 8], [3, 9, 8]], loop: true},
         {circle: [7, 9, 0.2], path: [[0, 7, 9], [2, 8, 9]], jumps: true}]
subgoals: [[3, 9]]
start: [1, 1, 0.1]
target: [9, 1]
target_radius: 0.2
)";

world::WorldFile read(const std::string& text) {
  auto world = world::read_world_file(text, "room.yaml");
  if (!world.ok()) ADD_FAILURE() << world.error().text();
  return std::move(world).value();
}

TEST(WorldText, ReadsBackAsItself) {
  const std::string text = world_text(read(kRoom));

  EXPECT_EQ(world_text(read(text)), text);
  EXPECT_EQ(read(text).moving.front().path.size(), 2u);
  EXPECT_TRUE(read(text).moving.front().loop);
  EXPECT_FALSE(read(text).moving.front().jumps);
  EXPECT_TRUE(read(text).moving.back().jumps);
  EXPECT_EQ(read(text).about, "a \"room\"\x07\n");
}

TEST(WorldText, KeepsEveryShippedWorld) {
  const runtime::ConfigPath configs({tests::source_path("configs")});
  for (const std::string& name : configs.names("worlds")) {
    const world::WorldFile world = read(configs.find("worlds", name)->text);
    const world::WorldFile again = read(world_text(world));
    EXPECT_EQ(world_text(again), world_text(world)) << name;
    EXPECT_EQ(again.walls.size() + again.circles.size() + again.polygons.size(),
              world.walls.size() + world.circles.size() + world.polygons.size());
    EXPECT_EQ(again.shortest_path_m, world.shortest_path_m);
  }
}

TEST(SettleClaims, ComputesWhatAChangeHasMadeUntrue) {
  world::WorldFile world = read(kRoom);
  world.moving.clear();
  world.solvable = false;
  world.shortest_path_m = 3.0;

  ASSERT_TRUE(settle_claims(world, kRadius_m).ok());

  EXPECT_EQ(world.solvable, true);
  // Round the wall's end at (6, 7), 0.15 m away: about 2 sqrt(36 + 16) = 14.0 m of two legs.
  EXPECT_NEAR(world.shortest_path_m.value(), 14.6, 0.4);
  world.walls.push_back({{6.0, 7.0}, {6.0, 10.0}});
  ASSERT_TRUE(settle_claims(world, kRadius_m).ok());
  EXPECT_EQ(world.solvable, false);
  EXPECT_FALSE(world.shortest_path_m.has_value());
}

TEST(SettleClaims, SaysNothingOfAWorldThatMovesForEver) {
  world::WorldFile world = read(kRoom);

  ASSERT_TRUE(settle_claims(world, kRadius_m).ok());

  EXPECT_FALSE(world.solvable.has_value());
}

TEST(SettleClaims, RefusesAStartWhereTheRobotDoesNotFit) {
  world::WorldFile world = read(kRoom);
  world.start.x_m = 5.9;

  EXPECT_FALSE(settle_claims(world, kRadius_m).ok());
}

TEST(StartAt, IsTheNearestPlaceThatTheRobotGetsTo) {
  std::string closed = kRoom;
  closed.replace(closed.find("[[6, 0, 6, 7]]"), 14, "[[6, 0, 6, 10]]");
  const auto world = world::World::parse(closed, "room.yaml");
  ASSERT_TRUE(world.ok());

  const auto near = start_at(*world, kRadius_m, {0.4, 0.2, 0.25});
  const auto beyond = start_at(*world, kRadius_m, {0.9, 0.5, 0.0});

  ASSERT_TRUE(near.has_value());
  EXPECT_NEAR(near->x_m, 4.0, 0.05);
  EXPECT_NEAR(near->y_m, 2.0, 0.05);
  EXPECT_NEAR(near->heading_rad, core::kPi / 2.0, 1e-12);
  // The right half is closed off: beside the wall is as near as the robot gets.
  ASSERT_TRUE(beyond.has_value());
  EXPECT_NEAR(beyond->x_m, 6.0 - kRadius_m, 0.1);
  EXPECT_LT(beyond->x_m, 6.0 - kRadius_m);
}

TEST(StartAt, IsNotInAnObstacleThatIsThereAtTheBeginning) {
  const auto world = world::World::parse(kRoom, "room.yaml");
  ASSERT_TRUE(world.ok());

  const auto start = start_at(*world, kRadius_m, {0.8, 0.8, 0.0});

  ASSERT_TRUE(start.has_value());
  EXPECT_GT(world->clearance_m(start->position(), 1.0, 0.0), kRadius_m);
}

}  // namespace
}  // namespace clew::hunt

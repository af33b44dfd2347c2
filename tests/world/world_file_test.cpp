// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "tests/source_path.hpp"
#include "world/world.hpp"

namespace clew::world {
namespace {

namespace fs = std::filesystem;

std::string read_text(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

std::vector<fs::path> yaml_files(const std::string& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(tests::source_path(folder))) {
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

const char* const kComplete = R"(
format: clew-world/1
name: complete-1
about: "All keys."
bounds: [-1, -2, 12, 7]
walls: [[1, 2, 3, 4]]
polygons: [[[5, 1], [6, 1], [6, 2]]]
circles: [[8, 3, 0.5]]
moving: [{circle: [10, 1, 0.35], path: [[0, 10, 1], [2, 10, 5]], loop: true}]
subgoals: [[2, 6], [4, 6]]
start: [0, 0, 4]
target: [11, 6]
target_radius: 0.2
solvable: true
shortest_path: 12.5
)";

std::string with(std::string yaml, const std::string& from, const std::string& to) {
  return yaml.replace(yaml.find(from), from.size(), to);
}

TEST(WorldFile, GivesAllThatItSays) {
  const auto result = World::parse(kComplete, "complete.yaml");

  ASSERT_TRUE(result.ok()) << result.error().text();
  const World& world = *result;
  EXPECT_EQ(world.name(), "complete-1");
  EXPECT_EQ(world.about(), "All keys.");
  EXPECT_EQ(world.bounds_min(), Vec2(-1, -2));
  EXPECT_EQ(world.bounds_max(), Vec2(12, 7));
  ASSERT_EQ(world.walls().size(), 1u);
  EXPECT_EQ(world.walls()[0].b, Vec2(3, 4));
  ASSERT_EQ(world.polygons().size(), 1u);
  EXPECT_EQ(world.polygons()[0][2], Vec2(6, 2));
  ASSERT_EQ(world.circles().size(), 1u);
  EXPECT_EQ(world.circles()[0].radius_m, 0.5);
  ASSERT_EQ(world.moving().size(), 1u);
  EXPECT_EQ(world.moving()[0].radius_m, 0.35);
  EXPECT_TRUE(world.moving()[0].loop);
  EXPECT_EQ(world.moving()[0].path[1].time_s, 2.0);
  EXPECT_EQ(world.subgoals(), (std::vector<Vec2>{{2, 6}, {4, 6}}));
  // A heading of 4 rad is the same as 4 - 2 pi.
  EXPECT_EQ(world.start(), (Pose2{0.0, 0.0, 4.0 - 2.0 * core::kPi}));
  EXPECT_EQ(world.target(), Vec2(11, 6));
  EXPECT_EQ(world.target_radius_m(), 0.2);
  EXPECT_EQ(world.solvable(), true);
  EXPECT_EQ(world.shortest_path_m(), 12.5);
}

TEST(WorldFile, NeedsOnlyBoundsStartAndTarget) {
  const auto world = World::parse(
      "{format: clew-world/1, name: bare, bounds: [0, 0, 1, 1], start: [0.1, 0.1, 0], "
      "target: [0.9, 0.9], target_radius: 0.1}",
      "bare.yaml");

  ASSERT_TRUE(world.ok()) << world.error().text();
  EXPECT_EQ(world->about(), "");
  EXPECT_TRUE(world->walls().empty());
  EXPECT_FALSE(world->solvable().has_value());
  EXPECT_FALSE(world->shortest_path_m().has_value());
}

TEST(WorldFile, MayNameTheHeadingsAtTargetAndWaypoints) {
  const std::string places =
      "{format: clew-world/1, name: bare, bounds: [0, 0, 9, 9], start: [1, 1, 0], target: [8, 8], "
      "target_radius: 0.1, waypoints: [[2, 2], [3, 3, 0.4, 1.5], [4, 4, ~, -1, 0.3]]";
  const auto world = World::parse(places + ", target_heading: [4, 0.2]}", "bare.yaml");
  const auto plain = World::parse(places + ", target_heading: 0.5}", "bare.yaml");

  ASSERT_TRUE(world.ok()) << world.error().text();
  const std::vector<Waypoint>& mission = world->waypoints();
  ASSERT_EQ(mission.size(), 4u);
  EXPECT_FALSE(mission[0].heading);
  EXPECT_EQ(mission[1].heading->heading_rad, 1.5);
  EXPECT_EQ(mission[1].heading->tolerance_rad, GoalHeading::kTolerance_rad);
  EXPECT_EQ(mission[2].radius_m, 0.1);  // the target's
  EXPECT_EQ(mission[2].heading->heading_rad, -1.0);
  EXPECT_EQ(mission[2].heading->tolerance_rad, 0.3);
  EXPECT_EQ(mission[3].heading->heading_rad, 4.0 - 2.0 * core::kPi);
  EXPECT_EQ(mission[3].heading->tolerance_rad, 0.2);
  ASSERT_TRUE(plain.ok()) << plain.error().text();
  EXPECT_EQ(plain->target_heading()->heading_rad, 0.5);
  EXPECT_EQ(plain->target_heading()->tolerance_rad, GoalHeading::kTolerance_rad);
}

TEST(WorldFile, ARobotHasArrivedWithTheHeadingWithinItsToleranceOnBothSides) {
  const Waypoint waypoint{{1.0, 1.0}, 0.2, GoalHeading{3.1, 0.2}};

  EXPECT_TRUE(waypoint.is_reached_by({1.1, 1.0, 2.95}));
  EXPECT_TRUE(waypoint.is_reached_by({1.1, 1.0, -3.0}));
  EXPECT_FALSE(waypoint.is_reached_by({1.1, 1.0, -2.9}));
  EXPECT_FALSE(waypoint.is_reached_by({1.3, 1.0, 3.1}));
}

TEST(WorldFile, TakesNullForAnUnknownShortestPath) {
  const auto world =
      World::parse(with(kComplete, "shortest_path: 12.5", "shortest_path: null"), "");

  ASSERT_TRUE(world.ok()) << world.error().text();
  EXPECT_FALSE(world->shortest_path_m().has_value());
}

TEST(WorldFile, ATargetMayBeWhereAMovingObstacleStarts) {
  const auto world = World::parse(with(kComplete, "target: [11, 6]", "target: [10, 1]"), "");

  EXPECT_TRUE(world.ok()) << world.error().text();
}

TEST(WorldFile, EveryShippedWorldLoadsAndHasRoomForItsRobot) {
  const auto files = yaml_files("configs/worlds");

  EXPECT_GE(files.size(), 60u);
  for (const fs::path& file : files) {
    const auto world = World::parse(read_text(file), file.filename());
    ASSERT_TRUE(world.ok()) << world.error().text();
    EXPECT_EQ(world->name(), file.stem().string());
    // The papers' robot, which all shipped graphs use.
    const auto fits = world->check_robot_fits(0.15);
    EXPECT_TRUE(fits.ok()) << fits.error().text();
    EXPECT_GT(world->clearance_m(world->target(), 1.0, 0.0), 0.0) << file;
  }
}

// The first line of each invalid file says with what it is refused: `# refused: message`.
TEST(WorldFile, RefusesEveryInvalidFileWithItsMessage) {
  const auto files = yaml_files("tests/world/invalid");

  EXPECT_GE(files.size(), 50u);
  for (const fs::path& file : files) {
    const std::string text = read_text(file);
    const std::string mark = "# refused: ";
    ASSERT_EQ(text.substr(0, mark.size()), mark) << file;
    const std::string message = text.substr(mark.size(), text.find('\n') - mark.size());
    const bool has_place = message[0] >= '0' && message[0] <= '9';

    const auto world = World::parse(text, "w.yaml");

    ASSERT_FALSE(world.ok()) << file;
    EXPECT_EQ(world.error().text(), (has_place ? "w.yaml:" : "w.yaml: ") + message) << file;
  }
}

TEST(WorldFile, NeverCrashesOnATruncatedFile) {
  const std::string text = kComplete;
  for (std::size_t size = 0; size < text.size() - 2; ++size) {
    const auto world = World::parse(text.substr(0, size), "cut.yaml");

    // Whatever is cut off after the last required key leaves a valid file.
    if (size < text.find("target_radius: 0.2")) {
      EXPECT_FALSE(world.ok()) << size;
    }
  }
}

TEST(WorldFile, AnswersAnyDamageWithAnErrorOrAWorld) {
  const std::string text = kComplete;
  int refused = 0;
  for (std::uint32_t i = 0; i < 3000; ++i) {
    const core::Random random(core::RandomKey{i, 0, 0, 0});
    std::string damaged = text;
    const auto changes = static_cast<std::uint32_t>(1 + 3 * random.uniform(0));
    for (std::uint32_t k = 1; k <= changes; ++k) {
      const auto at =
          static_cast<std::size_t>(random.uniform(3 * k) * static_cast<double>(damaged.size()));
      // Another character of the file, or any byte.
      const auto other =
          static_cast<std::size_t>(random.uniform(3 * k + 1) * static_cast<double>(text.size()));
      damaged[at] = k % 2 == 1 ? text[other] : static_cast<char>(random.bits(3 * k + 2) & 0xff);
    }

    const auto world = World::parse(damaged, "damaged.yaml");

    if (world.ok()) {
      const Vec2 start = world->start().position();
      EXPECT_GE(world->cone_distance_m(start, 0.3, 0.2, 2.0, 1.0), 0.0);
      EXPECT_GE(world->sweep_disc(start, world->target(), 0.1, 0.0, 1.0).free_fraction, 0.0);
    } else {
      EXPECT_FALSE(world.error().message.empty());
      ++refused;
    }
  }
  EXPECT_GT(refused, 1000);
}

TEST(WorldFile, SaysWhatIsInTheRobotsWayAtTheStart) {
  const auto world =
      World::parse(with(kComplete, "start: [0, 0, 4]", "start: [7.3, 3, 0]"), "w.yaml");

  ASSERT_TRUE(world.ok());
  EXPECT_TRUE(world->check_robot_fits(0.15).ok());
  const auto fits = world->check_robot_fits(0.25);

  // The circle at x = 8 of radius 0.5 begins at 7.5.
  ASSERT_FALSE(fits.ok());
  EXPECT_EQ(
      fits.error().text(),
      "w.yaml:11:8: a robot of radius 0.25 m does not fit at the start [7.3, 3]: circles[0] is "
      "0.2 m away");
}

}  // namespace
}  // namespace clew::world

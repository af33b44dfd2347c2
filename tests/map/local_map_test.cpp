// SPDX-License-Identifier: Apache-2.0
#include "map/local_map.hpp"

#include <gtest/gtest.h>

#include "core/angle.hpp"

namespace clew::map {
namespace {

constexpr double kRadius_m = 0.15;

/// One ray of a robot at the origin that looks along x.
domain::Scan ray(double range_m) {
  domain::Scan scan;
  scan.range_max_m = 4.0;
  scan.bearing_step_rad = core::radians(1.0);
  scan.ranges_m.push_back(range_m);
  return scan;
}

/// A hit at (1.5, 0), to within a cell of 25 mm: from the skin of a robot of 0.15 m.
LocalMap map_of_a_hit() {
  LocalMap map({}, kRadius_m);
  map.see({}, ray(1.35));
  return map;
}

TEST(LocalMap, ToldByAScanMarksWhatIsFreeAndWhatIsHit) {
  const LocalMap map = map_of_a_hit();

  EXPECT_TRUE(map.seen().is(Mark::kHit, {1.5, 0.0}));
  EXPECT_TRUE(map.seen().is(Mark::kFree, {0.0, 0.0}));  // where the robot stands
  EXPECT_FALSE(map.seen().is(Mark::kFree, {2.0, 0.0}));
}

TEST(LocalMap, TellsWhatLiesNearALine) {
  const LocalMap map = map_of_a_hit();
  const auto near = [&](double distance_m, LocalMap::Ends ends) {
    // 0.2 m beside the hit, up to a cell.
    return map.is_near(Mark::kHit, {0.0, 0.2}, {3.0, 0.2}, distance_m, ends);
  };

  for (const auto ends : {LocalMap::Ends::kRound, LocalMap::Ends::kFlat}) {
    EXPECT_FALSE(near(0.17, ends));
    EXPECT_TRUE(near(0.23, ends));
  }
  EXPECT_FALSE(map.is_near(Mark::kSuspected, {0.0, 0.2}, {3.0, 0.2}, 0.23, LocalMap::Ends::kFlat));
}

TEST(LocalMap, CountsWhatLiesBeyondAnEndOnlyIfEndsAreRound) {
  const LocalMap map = map_of_a_hit();
  const Vec2 before(0.0, 0.0);
  const Vec2 short_of_it(1.4, 0.0);

  EXPECT_TRUE(map.is_near(Mark::kHit, before, short_of_it, 0.15, LocalMap::Ends::kRound));
  EXPECT_FALSE(map.is_near(Mark::kHit, before, short_of_it, 0.15, LocalMap::Ends::kFlat));
  EXPECT_FALSE(map.is_near(Mark::kHit, before, short_of_it, 0.05, LocalMap::Ends::kRound));
}

TEST(LocalMap, TakesALineWithoutLengthForAPlace) {
  const LocalMap map = map_of_a_hit();
  const Vec2 place(1.5, 0.1);

  EXPECT_TRUE(map.is_near(Mark::kHit, place, place, 0.15, LocalMap::Ends::kRound));
  EXPECT_FALSE(map.is_near(Mark::kHit, place, place, 0.05, LocalMap::Ends::kRound));
}

TEST(LocalMap, ForgetsAllThatWasSeen) {
  LocalMap map = map_of_a_hit();

  map.forget();

  EXPECT_TRUE(map.seen().state().tiles.empty());
}

TEST(LocalMap, IsTheSameAfterLoading) {
  const LocalMap map = map_of_a_hit();
  core::StateWriter writer;
  map.save(writer);
  LocalMap restored({}, kRadius_m);
  core::StateReader reader(writer.bytes());

  restored.load(reader);

  ASSERT_TRUE(reader.complete());
  EXPECT_TRUE(restored.seen().is(Mark::kHit, {1.5, 0.0}));
}

TEST(LocalMap, RefusesAStateInWhichACellHasTwoMarks) {
  SeenMap::State state = map_of_a_hit().seen().state();
  SeenMap::Tile& tile = state.tiles.begin()->second;
  tile.rows[static_cast<std::size_t>(Mark::kFree)][5] = 0b1000;
  tile.rows[static_cast<std::size_t>(Mark::kSuspected)][5] = 0b1100;
  core::StateWriter writer;
  writer(state);
  LocalMap restored({}, kRadius_m);
  core::StateReader reader(writer.bytes());

  restored.load(reader);

  EXPECT_FALSE(reader.complete());
  EXPECT_NE(reader.fault().find("a cell of the map has two marks"), std::string::npos)
      << reader.fault();
  EXPECT_TRUE(restored.seen().state().tiles.empty());
}

}  // namespace
}  // namespace clew::map

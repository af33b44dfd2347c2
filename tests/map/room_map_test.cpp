// SPDX-License-Identifier: Apache-2.0
#include "map/room_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.hpp"
#include "map/line_of_sight.hpp"
#include "random_map.hpp"

namespace clew::map {
namespace {

BlockedMap blocked_of(const RandomMap& map) {
  BlockedMap blocked{map.grid, {}};
  for (const std::uint8_t passable : map.passable) blocked.blocked.push_back(passable != 0 ? 0 : 1);
  return blocked;
}

// From a point to the nearest square of a blocked cell, or to the grid's border: by definition.
double distance_by_search(const BlockedMap& map, const Vec2& point, double reach_m) {
  const Vec2 size = map.grid.cell_m * Vec2(map.grid.columns, map.grid.rows);
  double nearest_m = std::min({reach_m, point.x(), point.y(), (size - point).minCoeff()});
  for (std::size_t i = 0; i < map.blocked.size(); ++i) {
    if (map.blocked[i] == 0) continue;
    const Vec2 away = (point - map.grid.centre(map.grid.cell(i))).cwiseAbs();
    const Vec2 beyond = (away - Vec2::Constant(0.5 * map.grid.cell_m)).cwiseMax(0.0);
    nearest_m = std::min(nearest_m, core::length(beyond));
  }
  return nearest_m;
}

TEST(RoomMap, IsTheDistanceToTheNearestBlockedSquare) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    BlockedMap blocked = blocked_of(random_map(seed, 31, 23, 0.01 * static_cast<double>(seed), 0));
    blocked.grid.cell_m = 0.25;

    const RoomMap room = room_around(blocked, 1.1);

    for (std::size_t i = 0; i < room.room_m.size(); ++i) {
      const Vec2 middle = blocked.grid.centre(blocked.grid.cell(i));
      // Floats have 24 bits.
      ASSERT_NEAR(room.room_m[i], distance_by_search(blocked, middle, 1.1), 1e-6) << i;
    }
  }
}

TEST(RoomMap, HasRoomForADiscThatJustTouches) {
  // Five cells of 0.1 m, of which the first is blocked: the third's middle is 0.15 m from it, and
  // the borders above and below are 0.15 m away, too.
  BlockedMap blocked{{{0.0, 0.0}, 0.1, 5, 3}, std::vector<std::uint8_t>(15, 0)};
  blocked.blocked[5] = 1;
  const RoomMap room = room_around(blocked, 1.0);
  std::vector<std::uint8_t> flags;

  room.passable(0.15, flags);

  EXPECT_EQ(flags[7], 1);
  room.passable(0.1501, flags);
  EXPECT_EQ(flags[7], 0);
  EXPECT_EQ(flags[5], 0);
}

TEST(StraightWay, IsBlockedByAnyCellOnTheLine) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const RandomMap map = random_map(seed, 20, 15, 0.06, 0);
    const core::Random random({seed, 1, 0, 0});
    const Vec2 from(20.0 * random.uniform(0), 15.0 * random.uniform(1));
    const Vec2 to(20.0 * random.uniform(2), 15.0 * random.uniform(3));
    const Cell first = *map.grid.cell_at(from);
    const Cell last = *map.grid.cell_at(to);
    // Points a thousandth of the line apart see all cells that it cuts by more than 0.03.
    bool sampled_free = true;
    for (int i = 1; i < 1000; ++i) {
      const Cell cell = *map.grid.cell_at(from + i * 0.001 * (to - from));
      if (cell == first || cell == last) continue;
      sampled_free = sampled_free && map.passable[map.grid.index(cell)] != 0;
    }

    const bool free = line_of_sight(map.grid, map.passable, from, to);

    EXPECT_TRUE(!free || sampled_free) << seed;
    if (!free && sampled_free) {
      // It knows of a corner that the samples missed: moved aside by 0.03, they find it.
      bool near_miss = false;
      const Vec2 aside = 0.03 * Vec2(-(to - from).y(), (to - from).x()).normalized();
      for (int i = 1; i < 1000; ++i) {
        for (const Vec2& shift : {aside, Vec2(-aside)}) {
          const auto cell = map.grid.cell_at(from + i * 0.001 * (to - from) + shift);
          near_miss = near_miss || (cell && map.passable[map.grid.index(*cell)] == 0);
        }
      }
      EXPECT_TRUE(near_miss) << seed;
    }
  }
}

TEST(StraightWay, EndsAtTheGrid) {
  const RandomMap map = random_map(1, 10, 10, 0.0, 0);

  EXPECT_TRUE(line_of_sight(map.grid, map.passable, {0.5, 0.5}, {9.5, 9.5}));
  EXPECT_TRUE(line_of_sight(map.grid, map.passable, {0.5, 0.5}, {0.5, 0.5}));
  EXPECT_FALSE(line_of_sight(map.grid, map.passable, {0.5, 0.5}, {10.5, 0.5}));
  EXPECT_FALSE(line_of_sight(map.grid, map.passable, {-0.5, 0.5}, {5.0, 0.5}));
}

}  // namespace
}  // namespace clew::map

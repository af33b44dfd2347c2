// SPDX-License-Identifier: Apache-2.0
#include "map/widest_way.hpp"

#include <gtest/gtest.h>

#include <random>

namespace clew::map {
namespace {

constexpr Room kLevels[] = {Room::kOpen, Room::kNarrow, Room::kSuspected, Room::kTouching};

/// Whether eight neighbours connect two cells over those of the level and above: cell by cell.
bool connected(const Grid& grid, const std::vector<Room>& room, Room least, const Cell& start,
               const Cell& target) {
  std::vector<std::uint8_t> reached(grid.size(), 0);
  std::vector<Cell> open;
  const auto reach = [&](const Cell& cell) {
    if (!grid.contains(cell) || room[grid.index(cell)] < least) return;
    if (reached[grid.index(cell)]++ == 0) open.push_back(cell);
  };
  reach(start);
  while (!open.empty()) {
    const Cell here = open.back();
    open.pop_back();
    for (std::int32_t rows = -1; rows <= 1; ++rows) {
      for (std::int32_t columns = -1; columns <= 1; ++columns) {
        const Cell next{here.column + columns, here.row + rows};
        if (grid.contains(next) && reached[grid.index(next)] == 0) reach(next);
      }
    }
  }
  return reached[grid.index(target)] != 0;
}

Room widest_by_levels(const Grid& grid, const std::vector<Room>& room, const Cell& start,
                      const Cell& target) {
  for (const Room least : kLevels) {
    if (connected(grid, room, least, start, target)) return least;
  }
  return Room::kNone;
}

TEST(WidestWay, IsTheHighestLevelThatConnectsOnRandomMaps) {
  std::mt19937 dice(11);
  WidestWay widest;
  int of_level[5] = {};
  for (int round = 0; round < 400; ++round) {
    // One to three words of columns, and ends within words.
    const Grid grid{{0.0, 0.0}, 1.0, static_cast<std::int32_t>(20 + dice() % 130), 23};
    std::vector<Room> room(grid.size());
    const std::uint64_t open_tenths = 3 + dice() % 6;
    for (Room& cell : room) {
      cell = dice() % 10 < open_tenths ? Room::kOpen : static_cast<Room>(dice() % 4);
    }
    const Cell start{static_cast<std::int32_t>(dice()) & 15, 1};
    const Cell target{grid.columns - 1 - (static_cast<std::int32_t>(dice()) & 3), 21};
    room[grid.index(start)] = room[grid.index(target)] = Room::kOpen;

    const Room found = widest.between(grid, room, start, {target});

    ASSERT_EQ(found, widest_by_levels(grid, room, start, target)) << round;
    ++of_level[static_cast<std::size_t>(found)];
  }
  EXPECT_GT(of_level[static_cast<std::size_t>(Room::kOpen)], 20);
  EXPECT_GT(of_level[static_cast<std::size_t>(Room::kNarrow)], 20);
}

TEST(WidestWay, FollowsASnakeOverTheBordersOfWords) {
  // Rows 1, 3, 5, ... are walls with a gap at one end in turn.
  const Grid grid{{0.0, 0.0}, 1.0, 200, 21};
  std::vector<Room> room(grid.size(), Room::kNarrow);
  for (std::int32_t row = 1; row < grid.rows; row += 2) {
    for (std::int32_t column = 0; column < grid.columns; ++column) {
      const bool gap = column == (row % 4 == 1 ? grid.columns - 1 : 0);
      if (!gap) room[grid.index({column, row})] = Room::kNone;
    }
  }
  WidestWay widest;

  EXPECT_EQ(widest.between(grid, room, {0, 0}, {{199, 20}}), Room::kNarrow);
  room[grid.index({199, 9})] = Room::kTouching;  // the gap of a wall
  EXPECT_EQ(widest.between(grid, room, {0, 0}, {{199, 20}}), Room::kTouching);
  room[grid.index({199, 9})] = Room::kNone;
  EXPECT_EQ(widest.between(grid, room, {0, 0}, {{199, 20}}), Room::kNone);
}

TEST(WidestWay, TakesTheTargetWithTheWidestWay) {
  const Grid grid{{0.0, 0.0}, 1.0, 9, 1};
  std::vector<Room> room(grid.size(), Room::kOpen);
  room[2] = Room::kTouching;
  room[6] = Room::kSuspected;
  WidestWay widest;

  EXPECT_EQ(widest.between(grid, room, {4, 0}, {{0, 0}, {8, 0}}), Room::kSuspected);
  EXPECT_EQ(widest.between(grid, room, {4, 0}, {}), Room::kNone);
}

}  // namespace
}  // namespace clew::map

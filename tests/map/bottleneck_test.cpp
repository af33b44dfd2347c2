// SPDX-License-Identifier: Apache-2.0
#include "map/bottleneck.hpp"

#include <gtest/gtest.h>

#include <random>

namespace clew::map {
namespace {

constexpr Clearance kLevels[] = {Clearance::kOpen, Clearance::kNarrow, Clearance::kSuspected,
                                 Clearance::kTouching};

/// Whether eight neighbours connect two cells over those of the level and above: cell by cell.
bool connected(const Grid& grid, const std::vector<Clearance>& room, Clearance least,
               const Cell& start, const Cell& target) {
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

Clearance widest_by_levels(const Grid& grid, const std::vector<Clearance>& room, const Cell& start,
                           const Cell& target) {
  for (const Clearance least : kLevels) {
    if (connected(grid, room, least, start, target)) return least;
  }
  return Clearance::kNone;
}

TEST(Bottleneck, IsTheHighestLevelThatConnectsOnRandomMaps) {
  std::mt19937 dice(11);
  Bottleneck widest;
  int of_level[5] = {};
  for (int round = 0; round < 400; ++round) {
    // One to three words of columns, and ends within words.
    const Grid grid{{0.0, 0.0}, 1.0, static_cast<std::int32_t>(20 + dice() % 130), 23};
    std::vector<Clearance> room(grid.size());
    const std::uint64_t open_tenths = 3 + dice() % 6;
    for (Clearance& cell : room) {
      cell = dice() % 10 < open_tenths ? Clearance::kOpen : static_cast<Clearance>(dice() % 4);
    }
    const Cell start{static_cast<std::int32_t>(dice()) & 15, 1};
    const Cell target{grid.columns - 1 - (static_cast<std::int32_t>(dice()) & 3), 21};
    room[grid.index(start)] = room[grid.index(target)] = Clearance::kOpen;

    const Clearance found = widest.between(grid, room, start, {target});

    ASSERT_EQ(found, widest_by_levels(grid, room, start, target)) << round;
    ++of_level[static_cast<std::size_t>(found)];
  }
  EXPECT_GT(of_level[static_cast<std::size_t>(Clearance::kOpen)], 20);
  EXPECT_GT(of_level[static_cast<std::size_t>(Clearance::kNarrow)], 20);
}

TEST(Bottleneck, FollowsASnakeOverTheBordersOfWords) {
  // Rows 1, 3, 5, ... are walls with a gap at one end in turn.
  const Grid grid{{0.0, 0.0}, 1.0, 200, 21};
  std::vector<Clearance> room(grid.size(), Clearance::kNarrow);
  for (std::int32_t row = 1; row < grid.rows; row += 2) {
    for (std::int32_t column = 0; column < grid.columns; ++column) {
      const bool gap = column == (row % 4 == 1 ? grid.columns - 1 : 0);
      if (!gap) room[grid.index({column, row})] = Clearance::kNone;
    }
  }
  Bottleneck widest;

  EXPECT_EQ(widest.between(grid, room, {0, 0}, {{199, 20}}), Clearance::kNarrow);
  room[grid.index({199, 9})] = Clearance::kTouching;  // the gap of a wall
  EXPECT_EQ(widest.between(grid, room, {0, 0}, {{199, 20}}), Clearance::kTouching);
  room[grid.index({199, 9})] = Clearance::kNone;
  EXPECT_EQ(widest.between(grid, room, {0, 0}, {{199, 20}}), Clearance::kNone);
}

TEST(Bottleneck, TakesTheTargetWithTheWidestWay) {
  const Grid grid{{0.0, 0.0}, 1.0, 9, 1};
  std::vector<Clearance> room(grid.size(), Clearance::kOpen);
  room[2] = Clearance::kTouching;
  room[6] = Clearance::kSuspected;
  Bottleneck widest;

  EXPECT_EQ(widest.between(grid, room, {4, 0}, {{0, 0}, {8, 0}}), Clearance::kSuspected);
  EXPECT_EQ(widest.between(grid, room, {4, 0}, {}), Clearance::kNone);
}

}  // namespace
}  // namespace clew::map

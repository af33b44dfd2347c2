// SPDX-License-Identifier: Apache-2.0
#include "map/grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

namespace clew::map {
namespace {

TEST(Grid, FindsEachCellByItsMiddle) {
  const Grid grid{{-1.0, 2.0}, 0.25, 7, 5};

  for (std::size_t i = 0; i < grid.size(); ++i) {
    const Cell cell = grid.cell(i);

    EXPECT_EQ(grid.index(cell), i);
    EXPECT_TRUE(grid.cell_at(grid.centre(cell)) == cell) << i;
  }
}

TEST(Grid, IsHalfOpen) {
  const Grid grid{{0.0, 0.0}, 0.5, 4, 2};

  // 4 x 0.5 m = 2 m wide and 1 m high.
  EXPECT_TRUE(grid.cell_at({0.0, 0.0}) == (Cell{0, 0}));
  EXPECT_TRUE(grid.cell_at({0.5, 0.0}) == (Cell{1, 0}));
  EXPECT_FALSE(grid.cell_at({2.0, 0.5}).has_value());
  EXPECT_FALSE(grid.cell_at({1.0, 1.0}).has_value());
  EXPECT_FALSE(grid.cell_at({-0.01, 0.5}).has_value());
}

/// Each cell's value is its number in the plane.
std::vector<int> numbered(const Grid& grid, int fresh) {
  std::vector<int> values(grid.size(), fresh);
  for (std::int32_t row = 0; row < grid.rows; ++row) {
    for (std::int32_t column = 0; column < grid.columns; ++column) {
      const Vec2 cell = grid.corner / grid.cell_m + Vec2(column, row);
      values[grid.index({column, row})] = static_cast<int>(1000.0 * cell.x() + cell.y());
    }
  }
  return values;
}

TEST(Grid, KeepsInARingWhatItHasAndFreesWhatItLeaves) {
  std::mt19937_64 random(5);
  const auto below = [&](int end) {
    return static_cast<std::int32_t>(random() % static_cast<std::uint64_t>(end));
  };
  constexpr int kFresh = std::numeric_limits<int>::min();
  Grid grid = in_ring({}, {{0.0, 0.0}, 0.5, 20, 30});
  std::vector<int> values = numbered(grid, kFresh);
  std::vector<int> spare;
  int stayed = 0;
  int laid_anew = 0;
  for (int step = 0; step < 400; ++step) {
    const Grid before = grid;
    const std::int32_t side = step % 50 == 49 ? 60 + step : 1 + below(70);
    grid = in_ring(before, {before.corner + 0.5 * Vec2(below(31) - 15, below(31) - 15), 0.5, side,
                            1 + below(70)});
    const std::vector<int> numbers = numbered(grid, kFresh);
    const bool stays = shares_places(before, grid);
    (stays ? stayed : laid_anew)++;
    lay_out_anew(before, grid, kFresh, values, spare);

    ASSERT_EQ(values.size(), grid.size());
    int fresh = 0;
    const Cell shift = shift_between(before, grid);
    for (std::int32_t row = 0; row < grid.rows; ++row) {
      for (std::int32_t column = 0; column < grid.columns; ++column) {
        const std::size_t place = grid.index({column, row});
        ASSERT_EQ(grid.cell(place), (Cell{column, row}));
        const bool was = before.contains({column + shift.column, row + shift.row});
        ASSERT_EQ(values[place], was ? numbers[place] : kFresh) << step;
        fresh += was ? 0 : 1;
      }
    }
    // Nothing is left at places that no cell has.
    const auto held = static_cast<int>(
        std::count_if(values.begin(), values.end(), [&](int value) { return value != kFresh; }));
    ASSERT_EQ(held, grid.columns * grid.rows - fresh) << step;
    values = numbers;
  }
  EXPECT_GT(stayed, 300);
  EXPECT_GT(laid_anew, 3);
}

TEST(Grid, LaysOutAnewWhereACornerJumpsFarAway) {
  const Grid before = in_ring({}, {{0.0, 0.0}, 0.05, 64, 64});
  const Grid now = in_ring(before, {{1e9, -1e9}, 0.05, 64, 64});
  std::vector<int> values(before.size(), 7);
  std::vector<int> spare;

  lay_out_anew(before, now, 0, values, spare);

  EXPECT_EQ(std::count(values.begin(), values.end(), 7), 0);
}

}  // namespace
}  // namespace clew::map

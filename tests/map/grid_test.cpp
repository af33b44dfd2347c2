// SPDX-License-Identifier: Apache-2.0
#include "map/grid.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace clew::map

// SPDX-License-Identifier: Apache-2.0
#include "control/polar/polar_picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace clew::control {
namespace {

constexpr std::size_t kRings = 6;
constexpr std::size_t kSectors = 8;

PolarLandscape landscape() {
  PolarLandscape map({PolarLattice(kRings, kSectors, 1.0), 0.7});
  map.obstruct({0.0, 0.6}, 0.15);
  map.set_target({1.0, 0.0});
  map.settle(20);
  return map;
}

TEST(PolarPicture, DrawsEachUnitOnceWhereItLies) {
  domain::Picture picture;

  draw_landscape(landscape(), {2.0, 3.0, core::kPi / 2.0}, picture);

  ASSERT_EQ(picture.layers.size(), 2u);
  EXPECT_EQ(picture.layers[0].cells.size() + picture.layers[1].cells.size(), kRings * kSectors);
  // The unit 0.6 m to the left of a map that looks along y lies at (1.4, 3).
  ASSERT_EQ(picture.layers[1].cells.size(), 1u);
  core::Vec2 middle = core::Vec2::Zero();
  for (const core::Vec2& corner : picture.layers[1].cells[0].corners_odom) middle += 0.25 * corner;
  EXPECT_NEAR(middle.x(), 1.4, 0.05);  // a ring is 0.2 m wide, and bends by 22.5 degrees
  EXPECT_NEAR(middle.y(), 3.0, 1e-12);
}

TEST(PolarPicture, IsDarkestAtTheTarget) {
  domain::Picture picture;

  draw_landscape(landscape(), {}, picture);

  const auto& cells = picture.layers[0].cells;
  const auto darkest = std::max_element(
      cells.begin(), cells.end(), [](const auto& a, const auto& b) { return a.value < b.value; });
  EXPECT_EQ(darkest->value, 1.0);
  EXPECT_GT(darkest->corners_odom[0].x(), 0.8);  // the unit at (1, 0)
  EXPECT_EQ(std::min_element(cells.begin(), cells.end(),
                             [](const auto& a, const auto& b) { return a.value < b.value; })
                ->value,
            0.0);
}

TEST(PolarPicture, ShowsTheWindowAndTheChosenWay) {
  DynamicWindow window({}, {}, 0.15);
  window.choose(0.4, 0.0, 0.1, {{2.0, 0.0}, 0.0}, {{0.4, 0.05}}, {});
  domain::Picture picture;

  draw_window(window, {1.0, 1.0, 0.0}, 0.1, picture);

  ASSERT_EQ(picture.charts.size(), 1u);
  const domain::PictureChart& chart = picture.charts[0];
  EXPECT_EQ(chart.cells.size(), 7u * 15u);  // without braking, which is no cell of the grid
  EXPECT_EQ(chart.columns, 15u);
  const WindowCell& chosen = window.cells()[window.chosen()];
  EXPECT_EQ(chart.chosen_y, chosen.speed_mps);
  EXPECT_EQ(chart.chosen_x, chosen.turn_rate_radps);
  EXPECT_TRUE(std::any_of(chart.cells.begin(), chart.cells.end(),
                          [](const auto& cell) { return !cell.allowed; }));
  ASSERT_EQ(picture.layers.size(), 1u);
  EXPECT_EQ(picture.layers[0].places_odom.front(), core::Vec2(1.0, 1.0));
}

}  // namespace
}  // namespace clew::control

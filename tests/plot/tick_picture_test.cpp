// SPDX-License-Identifier: Apache-2.0
#include "plot/tick_picture.hpp"

#include <gtest/gtest.h>

#include "../recording/scratch_directory.hpp"
#include "small_run.hpp"

namespace clew::plot_test {
namespace {

using domain::PictureLayer;
using plot::InsideView;
using recording_test::read_bytes;
using recording_test::ScratchDirectory;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// One layer of each kind, and a chart of three by two cells.
InsideView view_of(std::uint64_t tick) {
  domain::Picture picture;
  const domain::PictureCell square{{core::Vec2(1.0, 0.2), {2.0, 0.2}, {2.0, 1.2}, {1.0, 1.2}}, 1.0};
  picture.layers.push_back({"worth", PictureLayer::Kind::kValues, {square}, {}});
  picture.layers.push_back({"shut", PictureLayer::Kind::kBlocked, {square}, {}});
  picture.layers.push_back({"seen", PictureLayer::Kind::kPoints, {}, {{1.0, 0.2}}});
  picture.layers.push_back({"road", PictureLayer::Kind::kWay, {}, {{1.0, 0.2}, {2.0, 0.2}}});
  picture.layers.push_back({"aim", PictureLayer::Kind::kGoal, {}, {{2.0, 0.2}}});
  domain::PictureChart chart;
  chart.name = "choices";
  chart.x_label = "left to right, m";
  chart.y_label = "depth, m";
  chart.columns = 3;
  for (const double y : {0.0, 1.0}) {
    for (const double x : {-1.0, 0.0, 1.0}) chart.cells.push_back({x, y, 0.0, x < 1.0});
  }
  picture.charts.push_back(chart);
  return {tick, {picture}};
}

class TickPicture : public testing::Test {
 protected:
  TickPicture() { SmallRun().write(recording_); }

  const ScratchDirectory scratch_;
  const std::string recording_ = scratch_.file("run.mcap");
};

TEST_F(TickPicture, NamesTickLayersAndCharts) {
  const std::string output = scratch_.file("out.svg");

  const auto plotted = plot::plot_tick(recording_, view_of(2), output);

  ASSERT_TRUE(plotted.ok()) << plotted.error().text();
  const std::string svg = read_bytes(output);
  for (const char* text : {"small: tick 2 (1 s)", "worth", "shut", "seen", "road", "aim", "choices",
                           "left to right, m"}) {
    EXPECT_TRUE(contains(svg, ">" + std::string(text) + "</text>")) << text;
  }
}

TEST_F(TickPicture, DrawsLayersWhereTheyAreInTheWorld) {
  const std::string output = scratch_.file("out.svg");

  ASSERT_TRUE(plot::plot_tick(recording_, view_of(2), output).ok());

  // At tick 2 the robot is at (2, 2) and believes to be at (1, 0.2): the way from there is from
  // (2, 2) to (3, 2). The map's corner is at (24, 80), 72 pixels a metre: 168, 512 and 240, 512.
  const std::string svg = read_bytes(output);
  EXPECT_TRUE(contains(svg, "<path d=\"M168 512L240 512\" fill=\"none\" stroke=\"#D55E00\""));
  EXPECT_TRUE(contains(svg, "#0072B2"));  // the value 1, at its darkest
}

TEST_F(TickPicture, TellsTwoLayersOfOneKindApart) {
  const std::string output = scratch_.file("out.svg");
  InsideView view = view_of(2);
  auto& layers = view.pictures[0].layers;
  layers.push_back({"other road", PictureLayer::Kind::kWay, {}, {{1.0, 0.2}, {2.0, 0.2}}});

  ASSERT_TRUE(plot::plot_tick(recording_, view, output).ok());

  const std::string svg = read_bytes(output);
  EXPECT_TRUE(contains(svg, "<path d=\"M168 512L240 512\" fill=\"none\" stroke=\"#D55E00\""));
  EXPECT_TRUE(contains(svg, "<path d=\"M168 512L240 512\" fill=\"none\" stroke=\"#CC79A7\""));
}

TEST_F(TickPicture, ShowsWhatMightNotBeChosen) {
  const std::string with = scratch_.file("with.svg");
  const std::string without = scratch_.file("without.svg");
  InsideView all_allowed = view_of(2);
  for (auto& cell : all_allowed.pictures[0].charts[0].cells) cell.allowed = true;

  ASSERT_TRUE(plot::plot_tick(recording_, view_of(2), with).ok());
  ASSERT_TRUE(plot::plot_tick(recording_, all_allowed, without).ok());

  EXPECT_NE(read_bytes(with), read_bytes(without));
}

TEST_F(TickPicture, RefusesATickWithoutAPose) {
  const auto plotted = plot::plot_tick(recording_, view_of(40), scratch_.file("out.svg"));

  ASSERT_FALSE(plotted.ok());
  EXPECT_EQ(plotted.error().text(), recording_ + ": has no pose of tick 40");
}

TEST_F(TickPicture, RefusesAnotherEnding) {
  const auto plotted = plot::plot_tick(recording_, view_of(2), "out.gif");

  ASSERT_FALSE(plotted.ok());
  EXPECT_EQ(plotted.error().text(), "out.gif: found ending '.gif'; allowed: .svg, .png, .pdf");
}

}  // namespace
}  // namespace clew::plot_test

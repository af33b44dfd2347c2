// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "plot/svg_writer.hpp"

namespace clew::plot {

/// A line of a chart, in the units of its axes.
struct ChartLine {
  std::string name;
  std::vector<Point> points;
};

/// A dashed level across a chart.
struct ChartLevel {
  std::string name;
  double y = 0.0;
};

/// Lines over a common x axis. Both axes begin at 0, the upright one below it where values are
/// negative.
struct LineChart {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<ChartLine> lines;
  std::vector<ChartLevel> levels;
};

/// The chart as an SVG picture; the same chart gives the same bytes.
std::string draw(const LineChart& chart);

}  // namespace clew::plot

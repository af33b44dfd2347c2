// SPDX-License-Identifier: Apache-2.0
/// The part of a behaviour's inside (inside.hpp) that is drawn over the map.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/geometry.hpp"

namespace clew::domain {

/// An area of the plane with a value.
struct PictureCell {
  std::array<core::Vec2, 4> corners_odom;
  double value = 0.0;  ///< in [0, 1]
};

/// Something to be drawn on the map, in the frame of odometry.
struct PictureLayer {
  enum class Kind : std::uint8_t {
    kValues,   ///< cells, the paler the less
    kBlocked,  ///< cells that may not be entered; values do not matter
    kPoints,   ///< places
    kWay,      ///< a line through places
    kGoal      ///< places to go to
  };

  std::string name;  ///< for the legend
  Kind kind = Kind::kPoints;
  std::vector<PictureCell> cells;
  std::vector<core::Vec2> places_odom;
};

/// A value over a grid of two numbers that are no place, such as velocities.
struct PictureChart {
  struct Cell {
    double x = 0.0;
    double y = 0.0;
    double value = 0.0;   ///< in [0, 1], the paler the less
    bool allowed = true;  ///< whether it might be chosen
  };

  std::string name;
  std::string x_label;      ///< with its unit
  std::string y_label;      ///< with its unit
  std::size_t columns = 1;  ///< cells of a row, which have the same y
  std::vector<Cell> cells;  ///< row by row
  double chosen_x = 0.0;
  double chosen_y = 0.0;
};

/// All that a behaviour shows of a tick; empty if it shows nothing.
struct Picture {
  std::vector<PictureLayer> layers;  ///< the lowest first
  std::vector<PictureChart> charts;

  bool empty() const { return layers.empty() && charts.empty(); }
};

}  // namespace clew::domain

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "core/geometry.hpp"
#include "map/seen_map.hpp"

namespace clew::recover {

/// Where a robot can go within some reach, by what was seen there: the local model of Nakhaeinia et
/// al. 2015. It is a disc of cells around the robot; those nearer to an obstacle than the room that
/// the body needs are closed, all others are open, also where nothing was seen. Its *exits* are the
/// cells at the rim to which open cells lead.
class LocalWays {
 public:
  /// `room_m` is kept between the robot's centre and obstacles.
  explicit LocalWays(double room_m) : room_m_(room_m) {}

  /// Takes what was seen within reach of a place.
  void look(const map::SeenMap& seen, const core::Vec2& place, double reach_m);

  /// Whether a way within reach leads to within `within_m` of the target, or of two cells if that
  /// is more; or to an exit from which the straight line to it meets nothing closed within reach.
  bool connect(const core::Vec2& target, double within_m = 0.0) const;
  /// Whether an exit lies within that angle of a heading.
  bool lead_on(double heading_rad, double within_rad) const;

 private:
  struct Cell {
    int x = 0;
    int y = 0;
  };

  void close_around(const core::Vec2& off_m);
  void flood();
  bool is_inside(const Cell& cell) const;
  std::size_t index(const Cell& cell) const;
  static Cell cell_at(const core::Vec2& off_m);
  static core::Vec2 middle(const Cell& cell);
  bool sees(const core::Vec2& from_m, const core::Vec2& to_m) const;

  double room_m_;
  core::Vec2 place_ = core::Vec2::Zero();
  double reach_m_ = 0.0;
  int half_ = 0;              // cells from the middle one to the rim
  std::vector<char> closed_;  // by index(); a disc within a square
  std::vector<char> reached_;
  std::vector<Cell> open_;  // all that open cells lead to, the nearest first
};

}  // namespace clew::recover

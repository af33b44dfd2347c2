// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "core/archive.hpp"
#include "core/geometry.hpp"
#include "domain/messages.hpp"
#include "map/grid.hpp"

namespace clew::map {

/// Where a robot's centre certainly cannot be: the body would touch what a beam has met, wherever
/// on the beam's arc that is. It is finer than the hits of a map, which stand for up to 0.1 m of
/// arc and for a cell: seen from near, a gap a few centimetres narrower than the robot is closed
/// here, and one that the robot fits through is not. Of the cells that ways are sought in it keeps
/// 64 parts each; a cell is closed if all of its parts are. That the robot was held somewhere
/// counts for nothing.
class NoRoom {
 public:
  struct State {
    /// By row and column of a cell, counted from the frame's origin: a bit for each part.
    std::map<std::pair<std::int32_t, std::int32_t>, std::uint64_t> parts;
  };

  explicit NoRoom(double radius_m) : radius_m_(radius_m) {}

  /// Takes in what is seen near the robot; `cell_m` is the side of a cell, always the same. The
  /// cell that the robot's centre is in is open.
  void see(const domain::Odometry& odometry, const domain::Scan& scan, double cell_m);
  void forget() { state_ = {}; }

  /// Calls `visit(middle)` for each cell that is closed.
  template <typename Visit>
  void for_each(double cell_m, Visit&& visit) const {
    for (const auto& [place, parts] : state_.parts) {
      if (parts == kAll) visit(Vec2(cell_m * Vec2(place.second + 0.5, place.first + 0.5)));
    }
  }

  void save(core::StateWriter& writer) const { writer(state_); }
  void load(core::StateReader& reader);

 private:
  /// A part, counted from the frame's origin as cells are.
  struct Part {
    std::int64_t column = 0;
    std::int64_t row = 0;
  };

  /// What was met: somewhere on an arc. A centre nearer to it than the radius has no room.
  struct Met {
    Vec2 right;  ///< ends of the arc
    Vec2 left;
    double radius_m = 0.0;
  };

  static constexpr std::uint64_t kAll = ~std::uint64_t{0};

  void close(const Met& met, const Part& first, std::int64_t side, double part_m);
  void keep(const Part& first, std::int64_t side);

  double radius_m_;
  std::vector<char> closed_;  // memory to work in: parts around the robot, row by row
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, NoRoom::State& s) {
  visit(s.parts);
}

}  // namespace clew::map

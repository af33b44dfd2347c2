// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "world_analysis/clearance_grid.hpp"

namespace clew::world_analysis {

/// A place where a robot that goes by the distance to its target gets no further.
///
/// Let d(p) be the straight distance from p to the target, on the free space of the robot's centre.
/// A *trap* is a local minimum m of d, other than the target, and its *depth* is the least rise of
/// d that every way from m to any place nearer to the target has to go through. The *trap's region*
/// are the places joined to m without going as high as that pass: from each of them, too, every way
/// on leads away from the target first. Shallow minima, as a slightly hollow wall has, are no
/// traps: the least depth is a parameter.
///
/// Depth is what computational topology calls the persistence of m in the sublevel sets of d
/// (Edelsbrunner, Letscher & Zomorodian 2002, "Topological persistence and simplification"); that
/// sensor-based navigation gets stuck in the local minima of d, and must leave by a place nearer
/// to the target than m, is the ground of the Bug algorithms (Lumelsky & Stepanov 1987; Kamon,
/// Rimon & Rivlin 1998, "TangentBug"), and that round obstacles have none, only saddles, that of
/// navigation functions (Koditschek & Rimon 1990).
struct Trap {
  static constexpr double kNoWayOut = std::numeric_limits<double>::infinity();

  Vec2 place = Vec2::Zero();  ///< m
  double nearest_m = 0.0;     ///< d(m)
  double depth_m = 0.0;       ///< kNoWayOut where nothing nearer to the target can be reached
  std::size_t nodes = 0;      ///< of the region, those of traps inside it included
  std::optional<std::size_t> inside_of;  ///< the trap whose region contains this one's
  bool from_start = false;  ///< whether the robot gets into it: there is a way from the start
};

/// The traps of a world, as obstacles stand at the grid's time.
class TrapMap {
 public:
  /// The free space are the grid's nodes with a clearance of at least radius_m, joined to their
  /// eight neighbours.
  TrapMap(const ClearanceGrid& grid, double radius_m, double least_depth_m);

  const std::vector<Trap>& traps() const { return traps_; }
  const Vec2& target() const { return grid_->world().target(); }

  /// The innermost trap whose region a place lies in, to the nearest free node; none outside.
  std::optional<std::size_t> trap_at(const Vec2& position) const;

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  class Flood;

  const ClearanceGrid* grid_;
  double radius_m_;
  std::vector<Trap> traps_;
  std::vector<std::uint32_t> trap_of_node_;
  std::vector<bool> is_free_;
};

}  // namespace clew::world_analysis

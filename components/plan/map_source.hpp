// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/archive.hpp"
#include "domain/messages.hpp"
#include "map/costmap.hpp"

namespace clew::plan {

/// What keeps the robot's centre out of the cells of a grid.
struct RoomView {
  const map::Grid& grid;
  const std::vector<map::Clearance>& room;  ///< by Grid::index
};

/// The map that a planner goes by, in the odometry frame.
class MapSource {
 public:
  virtual ~MapSource() = default;

  /// Takes in what a tick shows. Called once a tick, before anything is asked.
  virtual void see(const domain::Odometry& odometry, const domain::Scan& scan) = 0;
  /// Whether it may tell more, or something else, as time goes on.
  virtual bool changes() const = 0;

  /// The room in all cells that are known, and around both places; good until the next call.
  virtual RoomView read(const core::Vec2& from, const core::Vec2& to) = 0;
  /// Whether a straight line leads over nothing but places with at least this room, but for both
  /// ends.
  virtual bool line_of_sight(const core::Vec2& from, const core::Vec2& to,
                             map::Clearance least) = 0;

  /// Whether a body gets straight from one place to the other, both included, as exactly as the map
  /// tells it.
  virtual bool leads_straight(const core::Vec2& from, const core::Vec2& to) = 0;

  virtual void save(core::StateWriter& writer) const = 0;
  virtual void load(core::StateReader& reader) = 0;
};

}  // namespace clew::plan

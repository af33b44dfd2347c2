// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "map/costmap.hpp"
#include "map/local_map.hpp"
#include "plan/known_map.hpp"
#include "plan/map_source.hpp"

namespace clew::plan {

/// What the robot has seen so far, as a planner's map: unknown counts as free.
class SeenSource final : public MapSource {
 public:
  SeenSource(const map::LocalMapParameters& parameters, const RoomNeeds& needs);

  void see(const domain::Odometry& odometry, const domain::Scan& scan) override {
    local_map_.see(odometry, scan);
  }
  bool changes() const override { return true; }
  RoomView read(const core::Vec2& from, const core::Vec2& to) override;
  /// Measured on the marks themselves, a cell short of `least`, which holds at middles of cells.
  bool line_of_sight(const core::Vec2& from, const core::Vec2& to, map::Clearance least) override;
  bool leads_straight(const core::Vec2& from, const core::Vec2& to) override {
    return line_of_sight(from, to, map::Clearance::kTouching);
  }
  void save(core::StateWriter& writer) const override { local_map_.save(writer); }
  void load(core::StateReader& reader) override { local_map_.load(reader); }

 private:
  double room_of(map::Clearance least) const;

  map::LocalMap local_map_;
  map::Inflation inflation_;
  map::CostmapBuilder costmap_builder_;
};

}  // namespace clew::plan

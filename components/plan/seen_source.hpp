// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "map/costmap.hpp"
#include "map/scan_evidence.hpp"
#include "map/seen_map.hpp"
#include "plan/known_map.hpp"
#include "plan/map_source.hpp"

namespace clew::plan {

/// What the robot has seen so far: free, hit, suspected, and unknown, which counts as free. It
/// takes memory for the area seen, in at most so many tiles; what lies beyond them stays unknown.
class SeenSource final : public MapSource {
 public:
  struct Parameters {
    double cell_m = 0.05;  ///< of the cells that ways are sought in, twice those of the map
    std::size_t capacity_tiles = 4096;
    double hit_spread_m = 0.1;  ///< an obstacle on a piece of arc at most this long is certain
  };

  SeenSource(const Parameters& parameters, const RoomNeeds& needs);

  void see(const domain::Odometry& odometry, const domain::Scan& scan) override {
    evidence_.mark(odometry, scan, seen_);
  }
  bool changes() const override { return true; }
  RoomView read(const core::Vec2& from, const core::Vec2& to) override;
  /// Measured on the marks themselves, a cell short of `least`, which holds at middles of cells.
  bool line_of_sight(const core::Vec2& from, const core::Vec2& to, map::Clearance least) override;
  void save(core::StateWriter& writer) const override;
  void load(core::StateReader& reader) override { reader(seen_.state()); }

 private:
  bool is_near(map::Mark mark, const core::Vec2& from, const core::Vec2& to, double room_m) const;
  double room_of(map::Clearance least) const;

  map::ScanEvidence evidence_;
  map::SeenMap seen_;
  map::Inflation inflation_;
  map::CostmapBuilder clearance_;
};

}  // namespace clew::plan

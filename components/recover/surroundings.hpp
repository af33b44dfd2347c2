// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/archive.hpp"
#include "domain/messages.hpp"
#include "map/scan_evidence.hpp"
#include "map/seen_map.hpp"

namespace clew::recover {

struct SurroundingsParameters {
  double cell_m = 0.025;
  std::int64_t capacity_tiles = 4096;
  double hit_spread_m = 0.1;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, SurroundingsParameters& p) {
  visit.number("seen_cell_m", p.cell_m, "m", {0.01, 0.1},
               "side of a cell of what was seen; ways are sought in cells of twice the side");
  visit.integer("seen_capacity_tiles", p.capacity_tiles, "1", {1, 1000000},
                "tiles of 64 by 64 cells that are remembered");
  visit.number("seen_hit_spread_m", p.hit_spread_m, "m", {0.0, 0.3},
               "an obstacle on a piece of arc at most this long is certain");
}

/// All that a robot of one radius has seen during the run, in the odometry frame: kept once for
/// whoever asks for it, detector, shadows and escapes.
class Surroundings {
 public:
  Surroundings(const SurroundingsParameters& parameters, double radius_m)
      : parameters_(parameters),
        evidence_({parameters.hit_spread_m, kClearMargin_m}, radius_m),
        map_(parameters.cell_m, static_cast<std::size_t>(parameters.capacity_tiles)) {}

  /// Takes in what a tick shows.
  void see(const domain::Odometry& odometry, const domain::Scan& scan) {
    evidence_.mark(odometry, scan, map_);
  }
  void forget() { map_.state() = {}; }

  const SurroundingsParameters& parameters() const { return parameters_; }
  const map::SeenMap& map() const { return map_; }

  void save(core::StateWriter& writer) const { writer(map_.state()); }
  void load(core::StateReader& reader) { reader(map_.state()); }

 private:
  static constexpr double kClearMargin_m = 0.01;  // free parts end so far before what returned

  SurroundingsParameters parameters_;
  map::ScanEvidence evidence_;
  map::SeenMap map_;
};

}  // namespace clew::recover

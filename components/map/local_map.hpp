// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>

#include "core/archive.hpp"
#include "domain/messages.hpp"
#include "map/costmap.hpp"
#include "map/scan_evidence.hpp"
#include "map/seen_map.hpp"

namespace clew::map {

struct LocalMapParameters {
  double cell_m = 0.025;               ///< side of a cell; paths are sought in cells of twice that
  std::int64_t capacity_tiles = 4096;  ///< of SeenMap
  double hit_spread_m = 0.1;           ///< an obstacle on an arc at most this long is certain
};

/// All that a robot of one radius has seen during the run, in the odometry frame: free, hit,
/// suspected, and unknown. It takes memory for the area seen, as far as its capacity; what lies
/// beyond stays unknown.
class LocalMap {
 public:
  /// The robot's centre keeps this much room around all that was seen, so that a path may lead
  /// around it.
  static constexpr double kAround_m = 1.0;

  /// What counts as near to a line between two places.
  enum class Ends : std::uint8_t {
    kRound,  ///< what is within the distance of either end, too
    kFlat    ///< only what lies beside the line, not before or behind it
  };

  LocalMap(const LocalMapParameters& parameters, double radius_m)
      : parameters_(parameters),
        radius_m_(radius_m),
        evidence_({parameters.hit_spread_m, kClearMargin_m}, radius_m),
        seen_(parameters.cell_m, static_cast<std::size_t>(parameters.capacity_tiles)) {}

  /// Takes in what a tick shows.
  void see(const domain::Odometry& odometry, const domain::Scan& scan) {
    evidence_.mark(odometry, scan, seen_);
  }
  void forget() { seen_.restore({}); }
  /// What was seen is this.
  void restore(SeenMap::State seen) { seen_.restore(std::move(seen)); }

  /// The side of the cells that paths are sought in.
  double path_cell_m() const { return 2.0 * parameters_.cell_m; }
  double radius_m() const { return radius_m_; }
  const SeenMap& seen() const { return seen_; }
  /// What is impossible and what touches, for this robot on this map; the costs are the defaults.
  Inflation inflation() const {
    return inflation_of(radius_m_, parameters_.hit_spread_m, parameters_.cell_m);
  }

  /// Whether a cell of that mark lies nearer than `distance_m` to the line between two places.
  bool is_near(Mark mark, const Vec2& from, const Vec2& to, double distance_m, Ends ends) const;

  void save(core::StateWriter& writer) const { writer(seen_.state()); }
  void load(core::StateReader& reader) {
    SeenMap::State seen;
    reader(seen);
    if (!reader.check(is_valid(seen), "a cell of the map has two marks")) seen = {};
    restore(std::move(seen));
  }

 private:
  static constexpr double kClearMargin_m = 0.01;  // free parts end so far before what returned

  LocalMapParameters parameters_;
  double radius_m_;
  ScanEvidence evidence_;
  SeenMap seen_;
};

}  // namespace clew::map

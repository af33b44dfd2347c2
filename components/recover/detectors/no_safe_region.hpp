// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "core/angle.hpp"
#include "core/result.hpp"
#include "domain/setup.hpp"
#include "recover/detectors/trap_detector.hpp"
#include "scan/safe_regions.hpp"

namespace clew::recover {

struct NoSafeRegionParameters {
  double sector_rad = core::radians(90.0);
  double depth_ratio = 0.6;
  double clearance_m = 0.02;
  double seen_ratio = 0.5;
  std::int64_t ticks = 3;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, NoSafeRegionParameters& p) {
  visit.angle("sector_deg", p.sector_rad, {1.0, 180.0},
              "a gap within this angle of the target's bearing can lead to it");
  visit.number("depth_ratio", p.depth_ratio, "1", {0.01, 1.0},
               "a gap must be free for this share of the range, or as far as the target");
  visit.number("clearance_m", p.clearance_m, "m", {0.0, 1.0},
               "clearance of a gap on both sides of the body");
  visit.number("seen_ratio", p.seen_ratio, "1", {0.01, 1.0},
               "least share of the sector that must be in view; below it no trap is reported");
  visit.integer("ticks", p.ticks, "ticks", {1, 1000},
                "number of ticks in a row without a gap that make a trap");
}

/// The local minimum criterion of Nakhaeinia et al. 2015, section II.B: *the robot is surrounded by
/// the obstacles and there is no safe region (navigable area) in the possible robot paths that
/// connect to the target*.
///
/// Readings of ours: paths that connect to the target begin within 90 degrees of its bearing; a
/// safe region is a run of directions in which the disc may go for depth_ratio of the range, or as
/// far as the target is (world/safe_regions.hpp); the target is the one in force, actual or
/// virtual. The paper sees all round the robot. With a sensor that does not, what is in view
/// decides as long as that is seen_ratio of the sector; and what is seen must hold for some ticks,
/// since a robot that faces a wall sees nothing else for a moment.
class NoSafeRegion final : public TrapDetector {
 public:
  using Parameters = NoSafeRegionParameters;

  struct State {
    std::int64_t in_a_row = 0;
    bool told = false;  ///< and nothing has changed since
  };

  /// Refuses scans that leave room between their beams, or never see enough of the sector.
  static core::Result<std::unique_ptr<NoSafeRegion>> create(const Parameters& parameters,
                                                            const domain::BehaviourSetup& setup);
  NoSafeRegion(const Parameters& parameters, double radius_m)
      : parameters_(parameters), regions_(radius_m, parameters.clearance_m) {}

  std::optional<TrapEvidence> observe(const Situation& situation) override;
  void start_afresh() override { state_ = {}; }
  void tell(const Situation& situation, domain::Inside& inside) const override;
  void save(core::StateWriter& writer) const override;
  void load(core::StateReader& reader) override;

 private:
  bool surrounded(const Situation& situation);

  Parameters parameters_;
  scan::SafeRegions regions_;  // of the tick's scan
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, NoSafeRegion::State& s) {
  visit(s.in_a_row, s.told);
}

}  // namespace clew::recover

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "core/angle.hpp"
#include "core/result.hpp"
#include "domain/setup.hpp"
#include "recover/detectors/position_memory.hpp"
#include "recover/detectors/trap_detector.hpp"

namespace clew::recover {

struct PositionRevisitParameters {
  double grid_m = 0.5;
  double spacing_m = 0.1;
  double loop_length_m = 1.0;
  double place_full_m = 0.1;
  double place_none_m = 0.4;
  double place_drift_ratio = 0.005;
  double direction_full_rad = core::radians(15.0);
  double direction_none_rad = core::radians(45.0);
  double direction_drift_radpm = 0.002;
  double drift_sigmas = 0.0;
  bool other_direction = false;
  double threshold = 0.5;
  std::int64_t recognitions = 3;
  std::int64_t capacity = 16384;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, PositionRevisitParameters& p) {
  visit.number("grid_m", p.grid_m, "m", {0.1, 10.0}, "width of a cell of the position memory");
  visit.number("spacing_m", p.spacing_m, "m", {0.01, 10.0},
               "spacing of the positions that are stored and compared");
  visit.number("loop_length_m", p.loop_length_m, "m", {0.0, 1000.0},
               "least path length between two visits that count");
  visit.number("place_full_m", p.place_full_m, "m", {0.0, 10.0},
               "same place: degree 1 up to this distance");
  visit.number("place_none_m", p.place_none_m, "m", {0.01, 10.0},
               "same place: degree 0 beyond this distance");
  visit.number("place_drift_ratio", p.place_drift_ratio, "1", {0.0, 1.0},
               "both distances grow by this share of the path between the visits, at most to a "
               "cell's width");
  visit.angle("direction_full_deg", p.direction_full_rad, {0.0, 180.0},
              "same direction: degree 1 up to this angle");
  visit.angle("direction_none_deg", p.direction_none_rad, {0.1, 360.0},
              "same direction: degree 0 beyond this angle");
  visit.number("direction_drift_radpm", p.direction_drift_radpm, "rad/m", {0.0, 1.0},
               "both angles grow by this for each metre of path between the visits");
  visit.number(
      "drift_sigmas", p.drift_sigmas, "1", {0.0, 5.0},
      "all four grow by so many standard deviations of what odometry's covariance has grown "
      "by between the visits, the distances at most to two cells' width; 0: not at all");
  visit.flag("other_direction", p.other_direction,
             "whether a place that was seen before counts with another direction, too");
  visit.number("threshold", p.threshold, "1", {0.01, 1.0},
               "a position is recognised if the smaller degree is at least this");
  visit.integer("recognitions", p.recognitions, "1", {1, 1000},
                "number of recognitions in a row that make a limit cycle");
  visit.integer("capacity", p.capacity, "1", {2, 1048576}, "greatest number of cells remembered");
}

/// A limit cycle as Pin & Bender 1996 recognise it: the robot is again and again where it was
/// before, with the same direction of motion.
///
/// Each position that is `spacing_m` from the last one is compared with the earlier ones around, by
/// two fuzzy rules: *same place* falls from 1 at place_full to 0 at place_none, *same direction*
/// from direction_full to direction_none; both widen with the path L between the two visits, as
/// odometry's uncertainty does:
///
///     place = falling(|p - p'|, full + k L + n s_p, none + k L + n s_p)
///     direction = falling(|h - h'|, full + c L + n s_h, none + c L + n s_h)
///     recognised = min(place, direction) >= threshold
///
/// with n = drift_sigmas and the standard deviations s_p [m] and s_h [rad] that odometry's own
/// covariance tells of the way between the visits (pose_drift.hpp).
///
/// Where *same place* alone holds, the robot has been there *with another direction*, which the
/// paper tells apart. That is told, and makes no limit cycle, as in the paper; with
/// `other_direction` it counts as well: then the minimum is *place* alone.
///
/// `recognitions` positions in a row that are recognised make a limit cycle; the evidence is the
/// best earlier visit of the last one. A visit less than loop_length before is no earlier visit but
/// the same one.
///
/// Readings of ours: the paper gives no memberships, and says only that *several instances* are
/// noted. Cells are wider than *place_none* so that the nine cells around hold all candidates; the
/// drift widens it to a cell's width at most.
class PositionRevisit final : public TrapDetector {
 public:
  using Parameters = PositionRevisitParameters;

  struct State {
    bool begun = false;
    core::Vec2 last_odom = core::Vec2::Zero();  ///< position remembered last
    std::int64_t in_a_row = 0;
    std::int64_t turned_in_a_row = 0;  ///< of these, with another direction
  };

  /// Refuses a grid that is narrower than *same place* is wide, and memberships that do not fall.
  static core::Result<std::unique_ptr<PositionRevisit>> create(const Parameters& parameters,
                                                               const domain::BehaviourSetup& setup);
  explicit PositionRevisit(const Parameters& parameters);

  std::optional<TrapEvidence> observe(const Situation& situation) override;
  void start_afresh() override;
  void tell(const Situation& situation, domain::Inside& inside) const override;
  void save(core::StateWriter& writer) const override;
  void load(core::StateReader& reader) override;

 private:
  /// Cells on each side that may hold what is recognised.
  std::int64_t reach_cells() const { return parameters_.drift_sigmas > 0.0 ? 2 : 1; }
  struct Degrees {
    double place = 0.0;
    double direction = 0.0;
  };
  Degrees degrees(const PositionMemory::Visit& now, const PositionMemory::Visit& earlier) const;
  double recognition(const PositionMemory::Visit& now, const PositionMemory::Visit& earlier) const;
  std::optional<PositionMemory::Visit> recognised(const PositionMemory::Visit& now) const;

  Parameters parameters_;
  PositionMemory memory_;
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, PositionRevisit::State& s) {
  visit(s.begun, s.last_odom, s.in_a_row, s.turned_in_a_row);
}

}  // namespace clew::recover

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "core/result.hpp"
#include "domain/setup.hpp"
#include "recover/detectors/trap_detector.hpp"
#include "scan/safe_regions.hpp"

namespace clew::recover {

struct NoConnectingPathParameters {
  double depth_ratio = 1.0;
  double leg_clearance_m = 0.06;
  double clearance_m = 0.02;
  double close_m = 0.3;
  double leg_travel_ratio = 2.0;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, NoConnectingPathParameters& p) {
  visit.number("depth_ratio", p.depth_ratio, "1", {0.01, 1.0},
               "length of a leg as share of the range, or as far as the target");
  visit.number("leg_clearance_m", p.leg_clearance_m, "m", {0.0, 0.5},
               "clearance on both sides of the body along a leg");
  visit.number("clearance_m", p.clearance_m, "m", {0.0, 0.5},
               "clearance on both sides of the body along a path that connects");
  visit.number("close_m", p.close_m, "m", {0.01, 10.0},
               "the end of a leg is reached within this distance");
  visit.number("leg_travel_ratio", p.leg_travel_ratio, "1", {1.0, 100.0},
               "a leg ends after a path of this many times its length");
}

/// The local minimum criterion of Nakhaeinia et al. 2015 in the words that they tell figures 9 to
/// 11 with: *there is no safe region in the possible robot paths that connect to the target*,
/// decided where the robot comes to the end of a leg, *once the robot reaches at point "a"*. The
/// points a and b of figure 10, where its traps are detected, are virtual targets of the nearest
/// virtual target method.
///
/// Readings of ours:
/// - a leg leads to the virtual target with the shortest path robot, virtual target, target. It
///   ends where the robot is close to it, where the scan shows that it is not free, after some
///   travel, or with its target. While the robot sees a free straight line to the target it is on
///   no leg, and there is no trap;
/// - a path leads to where a leg may end and from there straight to the target, and connects if no
///   return in view lies in the way of the body. Legs may also be half and a quarter as long;
/// - a target that has just come in force, actual or virtual, is given a leg before it is judged.
///
/// The robot should be driven by nearest_virtual_target: the legs of other controllers are not
/// known here, and only their length ends them. A judgement, in a tick in which a leg ends,
/// compares each of n directions with up to n returns.
class NoConnectingPath final : public TrapDetector {
 public:
  using Parameters = NoConnectingPathParameters;

  struct State {
    bool has_target = false;
    core::Vec2 target_odom = core::Vec2::Zero();  ///< the one in force, where it has one
    bool on_leg = false;
    core::Vec2 leg_end_odom = core::Vec2::Zero();
    double leg_m = 0.0;                             ///< its length
    double travelled_m = 0.0;                       ///< on it
    core::Vec2 position_odom = core::Vec2::Zero();  ///< of the tick before
    bool told = false;                              ///< and no path has connected since
  };

  /// Refuses scans that leave room between their beams, or see less than 90 degrees.
  static core::Result<std::unique_ptr<NoConnectingPath>> create(
      const Parameters& parameters, const domain::BehaviourSetup& setup);
  NoConnectingPath(const Parameters& parameters, double radius_m);

  std::optional<TrapEvidence> observe(const Situation& situation) override;
  void start_afresh() override { state_ = {}; }
  void tell(const Situation& situation, domain::Inside& inside) const override;
  void save(core::StateWriter& writer) const override;
  void load(core::StateReader& reader) override;

 private:
  bool leg_is_over(const Situation& situation) const;
  void begin_leg(const Situation& situation);
  bool a_path_connects(const Situation& situation);
  bool connects(const core::Vec2& from, const core::Vec2& to) const;
  double depth_m(const Situation& situation) const;

  Parameters parameters_;
  double radius_m_;
  scan::SafeRegions leg_regions_;       // of the tick's scan
  scan::SafeRegions path_regions_;      // of the tick's scan, if it is judged
  std::vector<scan::SafeRegion> gaps_;  // scratch
  std::vector<core::Vec2> returns_;     // scratch
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, NoConnectingPath::State& s) {
  visit(s.has_target, s.target_odom, s.on_leg, s.leg_end_odom, s.leg_m, s.travelled_m,
        s.position_odom, s.told);
}

}  // namespace clew::recover

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "control/controller.hpp"
#include "control/gaps/virtual_target_rules.hpp"
#include "core/result.hpp"
#include "domain/setup.hpp"
#include "scan/safe_regions.hpp"

namespace clew::control {

struct NearestVirtualTargetParameters {
  std::string rules = "nakhaeinia_nvt";
  double clearance_m = 0.06;
  double keep_m = 0.1;
  double depth_ratio = 1.0;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, NearestVirtualTargetParameters& p) {
  visit.file("rules", p.rules, "rulebases", "rule base: Table 1, with its sets and consequents");
  visit.number("clearance_m", p.clearance_m, "m", {0.0, 0.5},
               "clearance beside the body in a safe region");
  visit.number("keep_m", p.keep_m, "m", {0.0, 2.0},
               "another gap must shorten the path by more than this");
  visit.number("depth_ratio", p.depth_ratio, "1", {0.01, 1.0},
               "a gap must be free for this share of the range, or as far as the target");
}

/// The nearest virtual target method (NVT) of Nakhaeinia et al. 2015, section II.A. Where obstacles
/// lie over the straight line to the target, each safe region gets a virtual target; the one with
/// the shortest path robot, virtual target, target wins, and a fuzzy controller with the 15 rules
/// of Table 1 steers to it.
///
/// *Our reading*, where the paper says nothing:
/// - a safe region is a run of directions that are free for depth_ratio of the range, or as far as
///   the target is; where there is none, half as far, and then a quarter. So a local minimum that
///   the scan sees whole is passed by, and one that is deeper is entered;
/// - a region's virtual target lies in its direction nearest to the target, at that depth;
/// - a gap is kept until another one is shorter by keep_m, so that a tie does not make the robot
///   turn to and fro;
/// - OD is the nearest return's distance from the skin, OP its angle from the virtual target's
///   bearing; R_V turns toward the virtual target and never past it in a tick;
/// - *deviation:* T_V is multiplied by the cosine of the virtual target's bearing, none beyond a
///   right angle: Table 1 alone drives on while the robot turns, into what it turns away from.
///
/// Where no direction is free it turns on the spot toward the target.
class NearestVirtualTarget final : public Controller {
 public:
  using Parameters = NearestVirtualTargetParameters;

  struct State {
    bool has_gap = false;
    core::Vec2 virtual_target_odom = core::Vec2::Zero();  ///< of the gap that it goes for
  };

  /// Refuses a scan with blind sectors between its beams, or too narrow a field to choose gaps in.
  static core::Result<std::unique_ptr<NearestVirtualTarget>> create(
      const Parameters& parameters, const domain::BehaviourSetup& setup);

  NearestVirtualTarget(const Parameters& parameters, const VirtualTargetRules& rules,
                       double radius_m, double tick_s);

  domain::Motion step(const domain::Odometry& odometry, const domain::Scan& scan,
                      const core::Vec2& target_odom) override;
  /// That of the gap that it goes for, unless it is the target itself.
  void tell_virtual_targets(VirtualTargets& targets) const override;
  void save(core::StateWriter& writer) const override;
  void load(core::StateReader& reader) override;
  void tell(const domain::Odometry& odometry, const domain::Scan& scan,
            const core::Vec2& target_odom, domain::Inside& inside) const override;

 private:
  void tell_gaps(const core::Pose2& pose, const core::Vec2& target_odom,
                 domain::Inside& inside) const;
  void tell_rules(double position_rad, double distance_m, domain::Inside& inside) const;
  std::optional<core::Vec2> choose(const core::Pose2& pose, const core::Vec2& target_odom,
                                   double range_m);
  const scan::SafeRegion* kept_gap(const core::Pose2& pose) const;
  core::Vec2 nearest_gap(const core::Pose2& pose, const core::Vec2& target_odom, double depth_m);
  domain::Motion steer(double bearing_rad, const domain::Scan& scan) const;

  Parameters parameters_;
  VirtualTargetRules rules_;
  double tick_s_;
  scan::SafeRegions regions_;           // of the present scan
  std::vector<scan::SafeRegion> gaps_;  // scratch
  bool steers_for_target_ = false;      // scratch: the virtual target of the last step lies on it,
                                        // or on the straight way there
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, NearestVirtualTarget::State& s) {
  visit(s.has_gap, s.virtual_target_odom);
}

}  // namespace clew::control

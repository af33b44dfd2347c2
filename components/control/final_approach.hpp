// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "control/step_guard.hpp"
#include "core/angle.hpp"
#include "core/archive.hpp"
#include "core/parameters.hpp"
#include "domain/messages.hpp"
#include "domain/setup.hpp"

namespace clew::control {

struct FinalApproachParameters {
  double approach_m = 1.2;
  double margin_m = 0.005;
  double turn_first_rad = core::radians(20.0);
  double look_again_m = 0.5;
  double set_off_m = 8.0;
  double first_m = 0.0;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, FinalApproachParameters& p) {
  visit.number(
      "approach_m", p.approach_m, "m", {0.0, 20.0},
      "within this distance of the target it goes straight there if the line is free; 0: never");
  visit.number("approach_margin_m", p.margin_m, "m", {0.0, 0.5},
               "clearance that the step guard keeps on the final approach");
  visit.angle("approach_turn_first_deg", p.turn_first_rad, {1.0, 180.0},
              "greater turns are made on the spot on the final approach");
  visit.number(
      "approach_look_again_m", p.look_again_m, "m", {0.0, 20.0},
      "distance after which it looks again at a target that was blocked and is out of view");
  visit.number(
      "approach_set_off_m", p.set_off_m, "m", {0.0, 1000.0},
      "before its first step it turns on the spot to a target within this distance behind it");
  visit.number(
      "approach_first_m", p.first_m, "m", {0.0, 20.0},
      "as approach_m, for a target that is so near when it is set, until its way is blocked");
}

/// Brings the robot in on a near target, whichever controller steers.
///
/// *Deviation, needed, ours:* in every controller that weighs the target against what is near, a
/// wall behind the target outweighs it: the robot turns away before it is there, or circles a
/// target that lies within its least turn. A robot that sees the way free goes straight there.
///
/// The way is free as long as no return is in it for certain (scan/certain_block.hpp); the step
/// guard cuts each step to what it holds free, with less room than elsewhere. Where that leaves no
/// step, or something is in the way, the controller steers on. Toward a target out of view the
/// robot turns on the spot to look, and if it finds the way blocked, does so again only
/// `look_again_m` on. Before it has moved it turns so to a target within `set_off_m`, too, that is
/// more than 60 degrees off its heading: the arc that a controller begins with costs more than the
/// way to a target behind. A robot that was where it believes the target to be and drives on has
/// drifted: from then on the controller alone looks for it. It does not know the mission: a target
/// that recovery has set is not its.
class FinalApproach {
 public:
  struct State {
    core::Vec2 target_odom = core::Vec2::Zero();  ///< the last
    bool blocked = false;                         ///< the way there was, or it was too far
    bool held = false;                            ///< the guard left no step of it
    bool was_there = false;  ///< the robot was where it believes the target to be
    core::Vec2 from_odom = core::Vec2::Zero();  ///< where the robot found that
  };

  FinalApproach(const FinalApproachParameters& parameters, const domain::BehaviourSetup& setup)
      : parameters_(parameters),
        radius_m_(setup.robot.radius_m),
        tick_s_(setup.tick_s),
        limits_(setup.limits) {}

  /// The motion to the target; nothing where the controller must steer.
  std::optional<domain::Motion> step(const domain::Odometry& odometry, const domain::Scan& scan,
                                     const core::Vec2& target_odom);
  /// The guard has left nothing of the last motion.
  void hold(const domain::Odometry& odometry);

  /// Of the step guard, in place of its own.
  StepGuard::Needs needs() const { return {parameters_.margin_m, kLeastStep_m}; }
  State& state() { return state_; }
  const State& state() const { return state_; }

 private:
  static constexpr double kLeastStep_m = 0.002;

  void note_blocked(const core::Vec2& position_odom);
  double reach_m() const;
  bool steers_still(const core::Vec2& position_odom, bool in_view) const;
  domain::Motion turn(double bearing_rad) const;
  double step_m(double distance_m) const;

  FinalApproachParameters parameters_;
  double radius_m_;
  double tick_s_;
  domain::MotionLimits limits_;
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, FinalApproach::State& s) {
  visit(s.target_odom, s.blocked, s.held, s.was_there, s.from_odom);
}

}  // namespace clew::control

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/archive.hpp"
#include "domain/messages.hpp"
#include "domain/setup.hpp"

namespace clew::control {

/// The target in force, as control knows it: from `guidance`, or else from `target`.
struct ActiveTarget {
  core::Vec2 position_odom = core::Vec2::Zero();
  double radius_m = 0.0;
  bool is_virtual = false;
  bool has_heading = false;
  double heading_rad = 0.0;
  double heading_tolerance_rad = 0.0;

  static ActiveTarget of(const domain::Guidance& guidance);
  static ActiveTarget of(const domain::Target& target);
};

/// Turns the robot on the spot to the heading that the mission wants at its target, whichever
/// controller steers: no paper's controller knows a heading of the goal.
///
/// It begins within half the target's radius, so that a drive which must brake still stops within
/// it; or within the radius, as soon as the robot comes no nearer. It goes on until the heading is
/// within the tolerance. If the run goes on then, odometry has drifted: the controller steers until
/// the robot was out of the radius, or has another target.
class HeadingTurn {
 public:
  struct State {
    core::Vec2 target_odom = core::Vec2::Zero();  ///< the last
    double distance_m = 0.0;                      ///< in the tick before
    bool turns = false;                           ///< it has begun, within the radius
    bool met = false;                             ///< the heading was, within the radius
  };

  explicit HeadingTurn(const domain::BehaviourSetup& setup)
      : tick_s_(setup.tick_s), limits_(setup.limits) {}

  /// The turn of this tick; nothing where the robot is to drive.
  std::optional<domain::Motion> step(const core::Pose2& pose_odom_robot,
                                     const ActiveTarget& target);

  State& state() { return state_; }
  const State& state() const { return state_; }

 private:
  double most_rad(double off_rad) const;

  double tick_s_;
  domain::MotionLimits limits_;
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, HeadingTurn::State& s) {
  visit(s.target_odom, s.distance_m, s.turns, s.met);
}

}  // namespace clew::control

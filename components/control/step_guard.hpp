// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "core/angle.hpp"
#include "core/archive.hpp"
#include "core/bounded_vector.hpp"
#include "domain/messages.hpp"
#include "domain/setup.hpp"

namespace clew::control {

struct StepGuardParameters {
  bool enabled = true;
  double margin_m = 0.05;
  double led_margin_m = 0.01;
  double least_step_m = 0.01;
  double turn_away_rad = core::radians(15.0);
};

template <typename Visitor>
void visit_parameters(Visitor& visit, StepGuardParameters& p) {
  visit.flag("guard", p.enabled, "whether the step guard cuts steps to what the scan shows free");
  visit.number("guard_margin_m", p.margin_m, "m", {0.0, 0.5},
               "clearance that is kept beside and before the body");
  visit.number("guard_led_margin_m", p.led_margin_m, "m", {0.0, 0.5},
               "the same where that leaves no step and recovery steers the robot along its path");
  visit.number("guard_least_step_m", p.least_step_m, "m", {0.0, 0.1},
               "a step that is cut to less than this is not made");
  visit.angle("guard_turn_deg", p.turn_away_rad, {1.0, 90.0},
              "turn in a tick, away from the nearest return, if no step is left");
}

/// Cuts a step to what is known to be free: the control law of Krishna & Kalra 2000 takes no step
/// to 0 and does not see beside itself, and collides as printed in half of the worlds.
///
/// A reading d of a beam stands for an arc of points at d + r from the centre. A disc of radius rho
/// = r + margin that moves off at an angle alpha from the arc's nearest end may go
///
///     (d + r) cos alpha - sqrt(rho^2 - ((d + r) sin alpha)^2)
///
/// before it touches; a reading at the sensor's least is none but *at most that*, and taken as 0.
/// Contacts that the bumpers felt are returns on the skin until the robot moves away, since the
/// cones do not see beside it: else drive and guard hold each other still. Where no step is left
/// the robot turns on the spot, away from the nearest return, and keeps that side until it moves
/// again; without that it deadlocks at corners. Steps that shrink toward an obstacle without end
/// count as nothing from least_step_m down.
///
/// A robot that recovery itself steers along a path is let through with less room where it would be
/// held: the path leads where it fits, and what holds it there would count as closed.
///
/// The guard binds every motion ahead, the overrides of recovery included: velocities and wheel
/// speeds as the turn and step that they make in a tick. A drive that brakes with a deceleration of
/// a needs v^2 / (2 a) after the tick to come to rest, so that as much stays free.
class StepGuard {
 public:
  struct State {
    std::int8_t turning_side = 0;  ///< 1 left, -1 right, 0 not turning on the spot
    double travel_m = 0.0;         ///< where the contacts are
    core::BoundedVector<double, domain::kMaxContacts> contacts_odom_rad;  ///< directions
  };

  StepGuard(const StepGuardParameters& parameters, const domain::BehaviourSetup& setup)
      : parameters_(parameters),
        radius_m_(setup.robot.radius_m),
        tick_s_(setup.tick_s),
        limits_(setup.limits) {}

  /// Who steers: recovery that leads to a place knows that there is room.
  enum class Steers : std::uint8_t { kAnybody, kLed };
  /// The motion, or what is allowed of it. Called every tick.
  domain::Motion limit(const domain::Motion& motion, const domain::Odometry& odometry,
                       const domain::Scan& scan, Steers steers = Steers::kAnybody);
  /// What a step must leave free, and what of it counts as nothing.
  struct Needs {
    double margin_m = 0.0;
    double least_step_m = 0.0;
  };
  /// The motion, or as much of its step as there is room for; nothing where that is less than a
  /// least step. For who knows better than to turn away.
  std::optional<domain::Motion> cut_step(const domain::Motion& motion,
                                         const domain::Odometry& odometry, const domain::Scan& scan,
                                         const Needs& needs);

  State& state() { return state_; }
  const State& state() const { return state_; }

 private:
  std::optional<domain::Motion> cut(const domain::Motion& motion, const domain::Odometry& odometry,
                                    const domain::Scan& scan, const Needs& needs);
  void keep_contacts(const domain::Odometry& odometry);
  double stopping_m(double step_m) const;
  double step_that_stops_within_m(double free_m) const;
  double free_m(double turn_rad, double wanted_m, double margin_m, const domain::Odometry& odometry,
                const domain::Scan& scan) const;
  double nearest_bearing_rad(const domain::Odometry& odometry, const domain::Scan& scan) const;

  StepGuardParameters parameters_;
  double radius_m_;
  double tick_s_;
  domain::MotionLimits limits_;
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, StepGuard::State& s) {
  visit(s.turning_side, s.travel_m, s.contacts_odom_rad);
}

}  // namespace clew::control

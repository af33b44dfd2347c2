// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/random.hpp"
#include "drive/drive_model.hpp"
#include "drive/motion_errors.hpp"

namespace clew::drive {

struct ActuatorParameters {
  double lag_s = 0.0;
  MotionErrors slip;

  /// Whether the robot moves otherwise than its drive has it.
  bool any() const { return lag_s != 0.0 || slip.any(); }
};

template <typename Visitor>
void visit_parameters(Visitor& visit, ActuatorParameters& p) {
  visit.number("lag_s", p.lag_s, "s", {0.0, 5.0},
               "time constant with which the motion follows the command; 0: at once");
  visit.number("slip_m_per_m", p.slip.m_per_m, "m/m", {0.0, 0.9},
               "share of the way that the wheels turn in vain");
  visit.number("slip_rad_per_rad", p.slip.rad_per_rad, "rad/rad", {0.0, 0.9},
               "share of a turn that the wheels turn in vain");
  visit.number("slip_m_per_sqrt_m", p.slip.m_per_sqrt_m, "m/m^0.5", {0.0, 0.5},
               "standard deviation of the way after a metre");
  visit.number("slip_rad_per_sqrt_m", p.slip.rad_per_sqrt_m, "rad/m^0.5", {0.0, 0.5},
               "standard deviation of the heading after a metre");
}

/// What lies between the motion that a drive makes of a command and the motion that comes of it:
/// actuators that follow late, and wheels that slip. Odometry counts the wheels.
///
/// With lag, each tick's turn, way and bend x become y = y' + (1 - exp(-tick_s / lag_s)) (x - y'),
/// y' being those of the tick before, as one leg. A command to stop, to give up or a late one
/// brakes at once, without lag. Of a way s that the wheels make, the robot goes
///
///     s (1 - slip_m_per_m) + slip_m_per_sqrt_m sqrt(|s|) N_3
///
/// but in a tick at least a twentieth and at most twice s: what does not fit comes in the ticks
/// after, so that the sum does not depend on how long a tick is. It turns by 1 - slip_rad_per_rad
/// of their turn and by slip_rad_per_sqrt_m sqrt(|s|) N_4 more, with N_i standard normal.
class Actuators {
 public:
  /// Chance does not owe more than this.
  static constexpr double kMostOwed_m = 1e9;

  /// Everything that lasts from one tick to the next.
  struct State {
    double turn_rad = 0.0;  ///< on the spot, of the wheels, in the last tick
    double step_m = 0.0;
    double bend_rad = 0.0;
    double duration_s = 0.0;  ///< of that tick; 0: none yet
    double owed_m = 0.0;      ///< of chance, that did not fit into it

    void add(const Leg& leg);
  };
  /// How the robot's motion differed from its wheels', in the last tick.
  struct Slip {
    double way_share = 1.0;  ///< of the wheels' way that the robot went
    double turn_share = 1.0;
    double error_rad = 0.0;  ///< that it turned besides
  };

  explicit Actuators(const ActuatorParameters& parameters) : parameters_(parameters) {}

  bool any() const { return parameters_.any(); }
  bool slips() const { return parameters_.slip.any(); }

  /// The motion that comes of `legs`; `brakes`: without lag.
  Legs act(const Legs& legs, bool brakes, const core::Random& random);
  /// The robot was stopped: so were its wheels.
  void come_to_rest();

  /// How the wheels moved in the last tick.
  Velocities wheels() const;
  /// Whether the robot's motion of the last tick was another one than `asked`.
  bool differs(const State& asked) const;
  const Slip& slip() const { return slip_; }

  const State& state() const { return state_; }
  State& state() { return state_; }

 private:
  ActuatorParameters parameters_;
  State state_;
  Slip slip_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, Actuators::State& s) {
  visit(s.turn_rad, s.step_m, s.bend_rad, s.duration_s, s.owed_m);
}

}  // namespace clew::drive

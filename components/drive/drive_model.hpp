// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/bounded_vector.hpp"
#include "domain/messages.hpp"
#include "domain/motion_conversion.hpp"
#include "domain/setup.hpp"

namespace clew::drive {

/// A piece of a tick's motion: a turn on the spot, then a way along the heading, straight or bent.
struct Leg {
  double turn_rad = 0.0;  ///< counter-clockwise positive
  double step_m = 0.0;    ///< length of the way, backwards if negative
  double duration_s = 0.0;
  double bend_rad = 0.0;  ///< change of the heading along the way, counter-clockwise positive
};

/// The motion of one tick, in order.
using Legs = core::BoundedVector<Leg, 16>;

using domain::Velocities;

/// The kinematics of a drive: what a command becomes when nothing is in the way. It has no memory.
class DriveModel {
 public:
  virtual ~DriveModel() = default;

  /// Simulated time that one command is in force.
  virtual double tick_s() const = 0;

  /// What the drive can do, for those who ask for motions.
  virtual domain::MotionLimits limits() const = 0;

  /// The motion that this drive makes of a command of any kind, within its limits, when it moves as
  /// `before` at the start. The durations add up to tick_s(). Stopping and giving up brake at once,
  /// whatever the drive's accelerations: they are the emergency stop.
  virtual Legs legs(const domain::Motion& motion, const Velocities& before) const = 0;
};

}  // namespace clew::drive

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/bounded_vector.hpp"
#include "domain/messages.hpp"

namespace clew::drive {

/// A piece of a tick's motion: a turn on the spot, then a straight way.
struct Leg {
  double turn_rad = 0.0;  ///< counter-clockwise positive
  double step_m = 0.0;    ///< ahead, at least 0
  double duration_s = 0.0;
};

/// The motion of one tick, in order. A model that drives arcs gives them as short legs.
using Legs = core::BoundedVector<Leg, 16>;

/// The kinematics of a drive: what a command becomes when nothing is in the way. It has no memory.
class DriveModel {
 public:
  virtual ~DriveModel() = default;

  /// Simulated time that one command is in force.
  virtual double tick_s() const = 0;

  /// The motion that this drive makes of a command of any kind, within its limits. The durations
  /// add up to tick_s().
  virtual Legs legs(const domain::Motion& motion) const = 0;
};

}  // namespace clew::drive

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/geometry.hpp"
#include "core/random.hpp"
#include "domain/inside.hpp"
#include "domain/messages.hpp"
#include "domain/setup.hpp"
#include "world/world.hpp"

namespace clew::sense {

/// A scan that was measured, and all that it was measured from.
struct Sweep {
  const world::World& world;
  const core::Pose2& pose_world_robot;
  double sim_time_s = 0.0;
  const core::Random& random;
  const domain::Scan& scan;
};

/// An arrangement of range sensors on the robot. It has no memory: a sweep is a function of where
/// the robot is, and when, and of the random numbers of the tick.
class RangeSensor {
 public:
  virtual ~RangeSensor() = default;

  /// The shape of every scan that measure() makes.
  virtual domain::ScanLayout layout() const = 0;

  /// Fills all of `scan` but its stamp, as its robot at pose_world_robot would measure it at
  /// sim_time_s.
  virtual void measure(const world::World& world, const core::Pose2& pose_world_robot,
                       double sim_time_s, const core::Random& random, domain::Scan& scan) const = 0;

  /// Tells how a scan that it has measured came about.
  virtual void tell(const Sweep&, domain::Inside&) const {}
};

}  // namespace clew::sense

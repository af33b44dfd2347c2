// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/geometry.hpp"
#include "world/world.hpp"

namespace clew::drive {

/// A way at constant speed, straight or along an arc, ahead or backwards, during an interval of
/// time.
class Stretch {
 public:
  /// From a pose, step_m along the heading (backwards if negative), which changes by bend_rad
  /// meanwhile.
  Stretch(const core::Pose2& from, double step_m, double bend_rad, double time_s,
          double duration_s);

  double time_s() const { return time_s_; }
  double duration_s() const { return duration_s_; }

  /// Where the robot is after a share of the way.
  core::Vec2 at(double fraction) const;
  /// The way's first part.
  Stretch until(double fraction) const;
  /// Whether moving along it, after a share of the way, brings the disc nearer to `point`.
  bool approaches(const core::Vec2& point, double fraction) const;

  /// How far a disc of radius_m gets, as World::sweep_disc tells of a straight way. An arc is swept
  /// as chords, by a disc that is larger by the arc's rise over the chord, and halved where that
  /// one touches until the rise is below kRise_m: the disc never touches, and stops at most twice
  /// that before what it would touch.
  world::Sweep sweep(const world::World& world, double radius_m) const;

  static constexpr double kRise_m = 1e-6;

 private:
  struct Part;
  double turned_rad(double fraction) const { return from_.heading_rad + fraction * bend_rad_; }
  world::Sweep sweep_part(const world::World& world, const Part& part, double radius_m) const;

  core::Pose2 from_;
  double step_m_;
  double bend_rad_;
  double time_s_;
  double duration_s_;
  core::Vec2 to_;
};

}  // namespace clew::drive

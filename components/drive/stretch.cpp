// SPDX-License-Identifier: Apache-2.0
#include "drive/stretch.hpp"

#include <cmath>

namespace clew::drive {
namespace {

// The rise of an arc of length s that bends by b is below s b / 8. On chords of up to a radian the
// robot's place at any time is off the chord's by less than a tenth more.
constexpr double kRiseShare = 1.1 / 8.0;
constexpr double kLargestBend_rad = 1.0;

/// Where an arc of this length and bend ends.
core::Vec2 arc_end(const core::Pose2& from, double step_m, double bend_rad) {
  const double half_rad = 0.5 * bend_rad;
  const double chord_m = step_m * core::sin(half_rad) / half_rad;
  return from.position() + chord_m * core::direction(from.heading_rad + half_rad);
}

}  // namespace

/// A piece of the way, as shares of it.
struct Stretch::Part {
  double begin;
  double end;
  double share() const { return end - begin; }
};

Stretch::Stretch(const core::Pose2& from, double step_m, double bend_rad, double time_s,
                 double duration_s)
    : from_(from),
      step_m_(step_m),
      bend_rad_(bend_rad),
      time_s_(time_s),
      duration_s_(duration_s),
      to_(bend_rad == 0.0 ? core::Vec2(from.position() + step_m * core::direction(from.heading_rad))
                          : arc_end(from, step_m, bend_rad)) {}

core::Vec2 Stretch::at(double fraction) const {
  if (bend_rad_ == 0.0) return from_.position() + fraction * (to_ - from_.position());
  if (fraction == 0.0) return from_.position();
  return arc_end(from_, fraction * step_m_, fraction * bend_rad_);
}

Stretch Stretch::until(double fraction) const {
  Stretch part = *this;
  part.to_ = at(fraction);
  part.step_m_ *= fraction;
  part.bend_rad_ *= fraction;
  part.duration_s_ *= fraction;
  return part;
}

bool Stretch::approaches(const core::Vec2& point, double fraction) const {
  const core::Vec2 way = bend_rad_ == 0.0
                             ? core::Vec2(to_ - from_.position())
                             : core::Vec2(step_m_ * core::direction(turned_rad(fraction)));
  return way.dot(point - at(fraction)) > 0.0;
}

world::Sweep Stretch::sweep(const world::World& world, double radius_m) const {
  if (bend_rad_ == 0.0 || step_m_ == 0.0) {
    return world.sweep_disc(from_.position(), to_, radius_m, time_s_, duration_s_);
  }
  return sweep_part(world, {0.0, 1.0}, radius_m);
}

/// Sweeps a part of an arc; the result's fraction is one of the whole way.
world::Sweep Stretch::sweep_part(const world::World& world, const Part& part,
                                 double radius_m) const {
  const double bend_rad = std::fabs(bend_rad_) * part.share();
  const double rise_m = kRiseShare * std::fabs(step_m_) * part.share() * bend_rad;
  const double grown_m = radius_m + rise_m;
  if (bend_rad <= kLargestBend_rad) {
    const double time_s = time_s_ + part.begin * duration_s_;
    const core::Vec2 from = at(part.begin);
    world::Sweep sweep =
        world.sweep_disc(from, at(part.end), grown_m, time_s, part.share() * duration_s_);
    sweep.free_fraction = part.begin + sweep.free_fraction * part.share();
    if (rise_m <= kRise_m) return sweep;
    // A disc that touches at the start and moves away is free; the arc may rise toward the
    // obstacle.
    const bool touches = world.clearance_m(from, 2.0 * grown_m, time_s) <= grown_m;
    if (!sweep.contact && !touches) return sweep;
  }
  const double middle = 0.5 * (part.begin + part.end);
  const world::Sweep first = sweep_part(world, {part.begin, middle}, radius_m);
  return first.contact ? first : sweep_part(world, {middle, part.end}, radius_m);
}

}  // namespace clew::drive

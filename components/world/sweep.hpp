// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/geometry.hpp"
#include "world/bvh.hpp"
#include "world/world.hpp"

namespace clew::world {

/// How far from an obstacle a swept disc stops. It covers rounding with room to spare, so the disc
/// never ends inside an obstacle, and nobody can see it.
inline constexpr double kSweepMargin_m = 1e-9;

/// A straight motion relative to an obstacle.
struct Motion {
  Vec2 from = Vec2::Zero();
  Vec2 way = Vec2::Zero();
};

/// The fraction of the way after which a disc comes to touch a segment (a point, if its ends are
/// the same); infinity if it does not. Touching at the start and moving away, or along, is none.
double contact_fraction(const Motion& motion, double radius_m, const World::Segment& segment);

/// A lower limit of contact_fraction for everything in a box; infinity if the disc misses it.
double contact_bound(const Motion& motion, double radius_m, const Box& box);

/// Sweeps a disc against one moving obstacle; if they touch earlier than `sweep` says, this contact
/// replaces the one there.
void sweep_against(const MovingObstacle& obstacle, const Motion& motion, double radius_m,
                   double time_s, double duration_s, Sweep& sweep);

}  // namespace clew::world

// SPDX-License-Identifier: Apache-2.0
#include "world/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "world/path_walk.hpp"
#include "world/shapes.hpp"

namespace clew::world {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
// Approaching by less than this on the whole way is moving along: rounding of the direction.
constexpr double kAlong_m = 1e-12;

// First fraction at which a point outside a circle reaches it.
double reach_circle(const Motion& motion, const Vec2& centre, double radius_m) {
  const Vec2 p{motion.from.x() - centre.x(), motion.from.y() - centre.y()};
  const double power = dot(p, p) - radius_m * radius_m;
  const double closing = -dot(p, motion.way);
  if (closing <= 0.0) return kNever;
  if (power <= 0.0) return 0.0;
  const double discriminant = closing * closing - dot(motion.way, motion.way) * power;
  return discriminant >= 0.0 ? power / (closing + std::sqrt(discriminant)) : kNever;
}

// First fraction at which a point outside reaches a line parallel to the segment, radius_m beside
// it, between the segment's ends.
double reach_side(const Motion& motion, const World::Segment& segment, double radius_m) {
  const Vec2 edge{segment.b.x() - segment.a.x(), segment.b.y() - segment.a.y()};
  const double length = core::length(edge);
  if (length == 0.0) return kNever;
  const Vec2 p{motion.from.x() - segment.a.x(), motion.from.y() - segment.a.y()};
  double beside = cross(edge, p) / length;
  double closing = -cross(edge, motion.way) / length;
  if (beside < 0.0) {
    beside = -beside;
    closing = -closing;
  }
  if (closing <= 0.0) return kNever;
  const double fraction = std::max((beside - radius_m) / closing, 0.0);
  const double along = (dot(edge, p) + fraction * dot(edge, motion.way)) / length;
  // A little beyond the ends, so that rounding leaves no gap between the sides and the end circles.
  return along >= -kSweepMargin_m && along <= length + kSweepMargin_m ? fraction : kNever;
}

double least_distance(const Motion& motion, const World::Segment& segment) {
  const World::Segment way{motion.from,
                           {motion.from.x() + motion.way.x(), motion.from.y() + motion.way.y()}};
  const auto sides = [](const World::Segment& s, const World::Segment& t) {
    const Vec2 edge{s.b.x() - s.a.x(), s.b.y() - s.a.y()};
    return cross(edge, {t.a.x() - s.a.x(), t.a.y() - s.a.y()}) *
           cross(edge, {t.b.x() - s.a.x(), t.b.y() - s.a.y()});
  };
  if (sides(way, segment) < 0.0 && sides(segment, way) < 0.0) return 0.0;
  return std::min(std::min(distance(way.a, nearest_point(segment, way.a)),
                           distance(way.b, nearest_point(segment, way.b))),
                  std::min(distance(segment.a, nearest_point(way, segment.a)),
                           distance(segment.b, nearest_point(way, segment.b))));
}

}  // namespace

// The distance to a convex shape is a convex function of the way: it falls, then rises. The disc
// stops at radius + margin, and only where it would come nearer than radius + margin / 2: so what
// has stopped may go on along the obstacle, although its distance is rounded.
double contact_fraction(const Motion& motion, double radius_m, const World::Segment& segment) {
  const double at_start = distance(motion.from, nearest_point(segment, motion.from));
  const double least = least_distance(motion, segment);
  if (least >= radius_m + 0.5 * kSweepMargin_m || at_start - least <= kAlong_m) return kNever;
  const double stop = radius_m + kSweepMargin_m;
  if (at_start <= stop) return 0.0;
  const double fraction =
      std::min({reach_side(motion, segment, stop), reach_circle(motion, segment.a, stop),
                reach_circle(motion, segment.b, stop)});
  // It does come that near: where rounding hides the place, the disc stays.
  return fraction <= 1.0 ? fraction : 0.0;
}

double contact_bound(const Motion& motion, double radius_m, const Box& box) {
  const double reach = radius_m + kSweepMargin_m;
  double enter = 0.0;
  double leave = 1.0;
  const auto cut = [&](double from, double way, double min, double max) {
    if (way == 0.0) return min <= from && from <= max;
    const double a = (min - from) / way;
    const double b = (max - from) / way;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
    return enter <= leave;
  };
  const bool hit = cut(motion.from.x(), motion.way.x(), box.min_x - reach, box.max_x + reach) &&
                   cut(motion.from.y(), motion.way.y(), box.min_y - reach, box.max_y + reach);
  return hit ? enter : kNever;
}

namespace {

// An obstacle that jumps stands at each of its points for a part of the way.
void sweep_against_jumping(const MovingObstacle& obstacle, const Motion& motion, double radius_m,
                           double time_s, double duration_s, Sweep& sweep) {
  const double end_s = time_s + duration_s;
  const World::Segment origin;
  std::size_t point = point_after(obstacle, time_s + kJumpTolerance_s);
  double begin = 0.0;  // of its stay, as a fraction of the way
  while (begin < sweep.free_fraction) {
    const Vec2& place = obstacle.path[point].position;
    const bool last = point + 1 == obstacle.path.size() ||
                      obstacle.path[point + 1].time_s >= end_s - kJumpTolerance_s;
    const double end = last ? 1.0 : (obstacle.path[point + 1].time_s - time_s) / duration_s;
    const Motion relative{motion.from + begin * motion.way - place, (end - begin) * motion.way};
    const double fraction =
        begin + contact_fraction(relative, radius_m + obstacle.radius_m, origin) * (end - begin);
    if (fraction < sweep.free_fraction) {
      sweep.free_fraction = fraction;
      sweep.contact = true;
      sweep.moving_obstacle = true;
      const Vec2 outward = motion.from + fraction * motion.way - place;
      const double length = core::length(outward);
      sweep.contact_point =
          length > 0.0 ? Vec2(place + outward * (obstacle.radius_m / length)) : place;
      return;
    }
    if (last) return;
    ++point;
    begin = end;
  }
}

}  // namespace

void sweep_against(const MovingObstacle& obstacle, const Motion& motion, double radius_m,
                   double time_s, double duration_s, Sweep& sweep) {
  if (obstacle.jumps) {
    return sweep_against_jumping(obstacle, motion, radius_m, time_s, duration_s, sweep);
  }
  const double end_s = time_s + duration_s;
  const double reach = radius_m + obstacle.radius_m;
  const World::Segment origin;
  PathWalk walk(obstacle, time_s);
  double begin = 0.0;  // of the obstacle's leg, as a fraction of the way
  Vec2 begin_position = walk.position_at(time_s);
  while (begin < sweep.free_fraction) {
    const bool last = walk.leg_end_s() >= end_s;
    const double leg_end_s = last ? end_s : walk.leg_end_s();
    const double end = last ? 1.0 : (leg_end_s - time_s) / duration_s;
    const Vec2 end_position = walk.position_at(leg_end_s);
    const Motion relative{motion.from + begin * motion.way - begin_position,
                          (end - begin) * motion.way - (end_position - begin_position)};
    const double fraction = begin + contact_fraction(relative, reach, origin) * (end - begin);
    if (fraction < sweep.free_fraction) {
      sweep.free_fraction = fraction;
      sweep.contact = true;
      sweep.moving_obstacle = true;
      const Vec2 centre = walk.position_at(time_s + fraction * duration_s);
      const Vec2 outward = motion.from + fraction * motion.way - centre;
      const double length = core::length(outward);
      sweep.contact_point =
          length > 0.0 ? Vec2(centre + outward * (obstacle.radius_m / length)) : centre;
      return;
    }
    if (last) return;
    walk.advance();
    begin = end;
    begin_position = walk.position_at(leg_end_s);
  }
}

}  // namespace clew::world

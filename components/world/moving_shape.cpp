// SPDX-License-Identifier: Apache-2.0
#include "world/moving_shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/angle.hpp"
#include "world/shapes.hpp"

namespace clew::world {
namespace {

// The discs of a row overlap by half: between two of them each face stands back by up to 2.7 mm.
constexpr double kSpacing_m = kSideRadius_m;
// Of a turn between two points of a disc's path: the row is shorter between them by 0.04 percent.
constexpr double kLargestTurn_rad = core::radians(3.0);

/// From 0, which is no disc's place, to 1, which is one's. A number of any size.
double discs_along(double length_m) { return std::max(1.0, std::ceil(length_m / kSpacing_m)); }

/// Takes `wanted` from what is `left`.
core::Result<void> take(const char* what, double wanted, std::size_t most, std::size_t& left) {
  if (wanted <= static_cast<double>(left)) {
    left -= static_cast<std::size_t>(wanted);
    return {};
  }
  return core::Error{
      fmt::format("its sides need {:.0f} {}; allowed: {} for all shapes together, and {} are left",
                  wanted, what, most, left)};
}

core::Result<void> take(double discs, double points_of_each, ShapeRoom& room) {
  CLEW_RETURN_IF_ERROR(take("discs, 2 cm apart", discs, kMostSideDiscs, room.discs));
  return take("points of their discs' paths", discs * points_of_each, kMostSidePoints, room.points);
}

/// Into how many small turns the one from `from` to `to` is cut.
double small_turns(const Turn& from, const Turn& to) {
  return std::max(1.0, std::ceil(std::fabs(to.angle_rad - from.angle_rad) / kLargestTurn_rad));
}

/// How many turns in_small_turns() makes; refused are those that are too fast.
core::Result<double> count_small_turns(const std::vector<Turn>& turns) {
  double sum = 1.0;
  for (std::size_t i = 1; i < turns.size(); ++i) {
    const double count = small_turns(turns[i - 1], turns[i]);
    const double span_s = turns[i].time_s - turns[i - 1].time_s;
    // Times rise by as much as they must, but for rounding.
    if (count > 1.0 && span_s / count < kLeastStep_s) {
      return core::Error{
          fmt::format("the door turns by {:.3g} rad in {:.3g} s; allowed: {:.0f} rad/s",
                      std::fabs(turns[i].angle_rad - turns[i - 1].angle_rad), span_s,
                      kLargestTurn_rad / kLeastStep_s)};
    }
    sum += count;
  }
  return sum;
}

/// The turns, with more between them where they are far apart.
std::vector<Turn> in_small_turns(const std::vector<Turn>& turns) {
  std::vector<Turn> small = {turns.front()};
  for (std::size_t i = 1; i < turns.size(); ++i) {
    const Turn& from = turns[i - 1];
    const double span_rad = turns[i].angle_rad - from.angle_rad;
    const double span_s = turns[i].time_s - from.time_s;
    const double count = small_turns(from, turns[i]);
    for (double step = 1.0; step < count; step += 1.0) {
      const double share = step / count;
      small.push_back({from.time_s + share * span_s, from.angle_rad + share * span_rad});
    }
    small.push_back(turns[i]);
  }
  return small;
}

}  // namespace

core::Result<std::vector<MovingObstacle>> discs_of(const Door& door, ShapeRoom& room) {
  const auto points = count_small_turns(door.turns);
  if (!points.ok()) return points.error();
  CLEW_RETURN_IF_ERROR(take(discs_along(door.length_m) + 1.0, *points, room));
  const std::vector<Turn> turns = in_small_turns(door.turns);
  const auto count = static_cast<std::size_t>(discs_along(door.length_m));
  std::vector<MovingObstacle> discs;
  for (std::size_t i = 0; i <= count; ++i) {
    const double from_hinge_m = door.length_m * static_cast<double>(i) / static_cast<double>(count);
    MovingObstacle& disc = discs.emplace_back();
    disc.radius_m = kSideRadius_m;
    disc.loop = door.loop;
    for (const Turn& turn : turns) {
      disc.path.push_back(
          {turn.time_s, door.hinge + from_hinge_m * core::direction(turn.angle_rad)});
    }
  }
  return discs;
}

core::Result<std::vector<MovingObstacle>> discs_of(const MovingPolygon& polygon, ShapeRoom& room) {
  const Polygon& outline = polygon.outline;
  double sum = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    sum += discs_along(distance(outline[i], outline[(i + 1) % outline.size()]));
  }
  CLEW_RETURN_IF_ERROR(take(sum, static_cast<double>(polygon.path.size()), room));
  std::vector<MovingObstacle> discs;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2& from = outline[i];
    const Vec2 side = outline[(i + 1) % outline.size()] - from;
    const auto count = static_cast<std::size_t>(discs_along(core::length(side)));
    for (std::size_t k = 0; k < count; ++k) {
      const Vec2 place = from + side * (static_cast<double>(k) / static_cast<double>(count));
      MovingObstacle& disc = discs.emplace_back();
      disc.radius_m = kSideRadius_m;
      disc.loop = polygon.loop;
      for (const MovingObstacle::Waypoint& point : polygon.path) {
        disc.path.push_back({point.time_s, place + (point.position - outline.front())});
      }
    }
  }
  return discs;
}

}  // namespace clew::world

// SPDX-License-Identifier: Apache-2.0
#include "world/moving_shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/angle.hpp"
#include "world/shapes.hpp"

namespace clew::world {
namespace {

// The discs of a row overlap by half: between two of them the row is thinner by 3 mm.
constexpr double kSpacing_m = kSideRadius_m;
// Of a turn between two points of a disc's path: the row is shorter between them by 0.04 percent.
constexpr double kLargestTurn_rad = core::radians(3.0);

/// From 0, which is no disc's place, to 1, which is one's.
std::size_t discs_along(double length_m) {
  return std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(length_m / kSpacing_m)));
}

core::Result<void> check_count(double discs) {
  if (discs <= static_cast<double>(kMostSideDiscs)) return {};
  return core::Error{fmt::format("its sides are too long: {:.0f} m; allowed: {:.0f} m",
                                 discs * kSpacing_m,
                                 static_cast<double>(kMostSideDiscs) * kSpacing_m)};
}

/// The turns, with more between them where they are far apart.
core::Result<std::vector<Turn>> in_small_turns(const std::vector<Turn>& turns) {
  std::vector<Turn> small = {turns.front()};
  for (std::size_t i = 1; i < turns.size(); ++i) {
    const Turn& from = turns[i - 1];
    const double span_rad = turns[i].angle_rad - from.angle_rad;
    const double span_s = turns[i].time_s - from.time_s;
    const double count = std::max(1.0, std::ceil(std::fabs(span_rad) / kLargestTurn_rad));
    if (span_s / count < kLeastStep_s) {
      return core::Error{
          fmt::format("the door turns by {:.3g} rad in {:.3g} s; allowed: {:.0f} rad/s",
                      std::fabs(span_rad), span_s, kLargestTurn_rad / kLeastStep_s)};
    }
    for (double step = 1.0; step < count; step += 1.0) {
      const double share = step / count;
      small.push_back({from.time_s + share * span_s, from.angle_rad + share * span_rad});
    }
    small.push_back(turns[i]);
  }
  return small;
}

}  // namespace

core::Result<std::vector<MovingObstacle>> discs_of(const Door& door) {
  CLEW_RETURN_IF_ERROR(check_count(door.length_m / kSpacing_m));
  const auto turns = in_small_turns(door.turns);
  if (!turns.ok()) return turns.error();
  const std::size_t count = discs_along(door.length_m);
  std::vector<MovingObstacle> discs;
  for (std::size_t i = 0; i <= count; ++i) {
    const double from_hinge_m = door.length_m * static_cast<double>(i) / static_cast<double>(count);
    MovingObstacle& disc = discs.emplace_back();
    disc.radius_m = kSideRadius_m;
    disc.loop = door.loop;
    for (const Turn& turn : *turns) {
      disc.path.push_back(
          {turn.time_s, door.hinge + from_hinge_m * core::direction(turn.angle_rad)});
    }
  }
  return discs;
}

core::Result<std::vector<MovingObstacle>> discs_of(const MovingPolygon& polygon) {
  const Polygon& outline = polygon.outline;
  double length_m = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    length_m += distance(outline[i], outline[(i + 1) % outline.size()]);
  }
  CLEW_RETURN_IF_ERROR(check_count(length_m / kSpacing_m));
  std::vector<MovingObstacle> discs;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2& from = outline[i];
    const Vec2 side = outline[(i + 1) % outline.size()] - from;
    const std::size_t count = discs_along(core::length(side));
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

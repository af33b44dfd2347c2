// SPDX-License-Identifier: Apache-2.0
#include "recover/detectors/local_ways.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/angle.hpp"
#include "core/math.hpp"

namespace clew::recover {
namespace {

constexpr double kCell_m = 0.05;

}  // namespace

void LocalWays::look(const map::SeenMap& seen, const core::Vec2& place, double reach_m) {
  place_ = place;
  reach_m_ = reach_m;
  half_ = static_cast<int>(reach_m / kCell_m) + 1;
  const auto side = static_cast<std::size_t>(2 * half_ + 1);
  closed_.assign(side * side, 0);
  reached_.assign(side * side, 0);
  const double around_m = reach_m + room_m_;
  const core::Vec2 corner(around_m, around_m);
  seen.for_each(map::Mark::kHit, place - corner, place + corner,
                [&](const core::Vec2& hit) { close_around(hit - place); });
  flood();
}

/// Closes what lies too near to an obstacle. One that the body touches leaves its own place open.
void LocalWays::close_around(const core::Vec2& off_m) {
  const double room_m = std::min(room_m_, core::length(off_m) - kCell_m);
  const int cells = static_cast<int>(room_m_ / kCell_m) + 1;
  const Cell at = cell_at(off_m);
  for (int y = std::max(-half_, at.y - cells); y <= std::min(half_, at.y + cells); ++y) {
    for (int x = std::max(-half_, at.x - cells); x <= std::min(half_, at.x + cells); ++x) {
      if (core::length(middle({x, y}) - off_m) < room_m) closed_[index({x, y})] = 1;
    }
  }
}

void LocalWays::flood() {
  constexpr std::array<Cell, 4> kBeside = {{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  open_.assign(1, {});
  reached_[index({})] = 1;
  for (std::size_t i = 0; i < open_.size(); ++i) {
    const Cell cell = open_[i];
    if (core::length(middle(cell)) >= reach_m_ - kCell_m) continue;
    for (const Cell& step : kBeside) {
      const Cell next{cell.x + step.x, cell.y + step.y};
      if (!is_inside(next) || reached_[index(next)] != 0 || closed_[index(next)] != 0) continue;
      reached_[index(next)] = 1;
      open_.push_back(next);
    }
  }
}

bool LocalWays::connect(const core::Vec2& target, double within_m) const {
  const core::Vec2 target_m = target - place_;
  const double met_m = std::max(2.0 * kCell_m, within_m);
  return std::any_of(open_.begin(), open_.end(), [&](const Cell& cell) {
    const core::Vec2 at_m = middle(cell);
    if (core::length(target_m - at_m) <= met_m) return true;
    return core::length(at_m) >= reach_m_ - kCell_m && sees(at_m, target_m);
  });
}

bool LocalWays::lead_on(double heading_rad, double within_rad) const {
  return std::any_of(open_.begin(), open_.end(), [&](const Cell& cell) {
    const core::Vec2 at_m = middle(cell);
    if (core::length(at_m) < reach_m_ - kCell_m) return false;
    const double bearing_rad = core::atan2(at_m.y(), at_m.x());
    return std::fabs(core::wrap_angle_rad(bearing_rad - heading_rad)) <= within_rad;
  });
}

/// Whether nothing closed lies on the straight line between two places.
bool LocalWays::sees(const core::Vec2& from_m, const core::Vec2& to_m) const {
  const core::Vec2 way_m = to_m - from_m;
  const double length_m = core::length(way_m);
  for (double along_m = kCell_m; along_m < length_m; along_m += kCell_m) {
    const core::Vec2 at_m = from_m + along_m / length_m * way_m;
    if (std::max(std::fabs(at_m.x()), std::fabs(at_m.y())) > reach_m_) return true;  // for good
    if (closed_[index(cell_at(at_m))] != 0) return false;
  }
  return true;
}

bool LocalWays::is_inside(const Cell& cell) const {
  return std::abs(cell.x) <= half_ && std::abs(cell.y) <= half_;
}

std::size_t LocalWays::index(const Cell& cell) const {
  return static_cast<std::size_t>((cell.y + half_) * (2 * half_ + 1) + cell.x + half_);
}

LocalWays::Cell LocalWays::cell_at(const core::Vec2& off_m) {
  return {static_cast<int>(std::floor(off_m.x() / kCell_m + 0.5)),
          static_cast<int>(std::floor(off_m.y() / kCell_m + 0.5))};
}

core::Vec2 LocalWays::middle(const Cell& cell) { return {cell.x * kCell_m, cell.y * kCell_m}; }

}  // namespace clew::recover

// SPDX-License-Identifier: Apache-2.0
#include "map/no_room.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace clew::map {
namespace {

constexpr std::size_t kMostCells = 16384;
constexpr std::int64_t kParts = 8;  // of a cell, along each side
// Places farther from the frame's origin than this many parts are left out.
constexpr double kFarthest = 1e9;
// What returned from farther than this many radii closes nothing that the map's hits do not.
constexpr double kNear_radii = 2.0;
// The body is taken to be smaller by this, for what readings round away.
constexpr double kSlack_m = 0.001;

std::int64_t floor_div(std::int64_t number) {
  return (number >= 0 ? number : number - kParts + 1) / kParts;
}

}  // namespace

void NoRoom::see(const domain::Odometry& odometry, const domain::Scan& scan, double cell_m) {
  const core::Pose2& pose = odometry.pose_odom_robot;
  const Vec2 robot = pose.position();
  const double part_m = cell_m / static_cast<double>(kParts);
  const double reach = kNear_radii * radius_m_ / part_m;
  if (!(robot.cwiseAbs().maxCoeff() / part_m + reach < kFarthest)) return;
  const auto least = [&](double middle) {
    return static_cast<std::int64_t>(std::floor(middle / part_m - reach));
  };
  const double body_m = radius_m_ - kSlack_m;
  const Part first{least(robot.x()), least(robot.y())};
  const auto side = static_cast<std::int64_t>(std::ceil(2.0 * reach)) + 1;
  closed_.assign(static_cast<std::size_t>(side * side), 0);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double range_m = scan.ranges_m[i];
    if (range_m <= scan.range_min_m || range_m >= scan.range_max_m) continue;
    const double distance_m = radius_m_ + range_m;
    if (distance_m > kNear_radii * radius_m_) continue;
    const double bearing_rad = pose.heading_rad + scan.bearing_rad(i);
    const double half_rad = 0.5 * scan.beam_width_rad;
    close({robot + distance_m * core::direction(bearing_rad - half_rad),
           robot + distance_m * core::direction(bearing_rad + half_rad), body_m},
          first, side, part_m);
  }
  keep(first, side);
  const auto cell = [&](double at) { return static_cast<std::int32_t>(std::floor(at / cell_m)); };
  state_.parts.erase({cell(robot.y()), cell(robot.x())});
}

/// Closes the parts in which every centre is nearer than the radius to both ends of the arc: then
/// it is so near to all of the arc, whose circle is no smaller than the body.
void NoRoom::close(const Met& met, const Part& first, std::int64_t side, double part_m) {
  const auto& [right, left, radius_m] = met;
  const double within_m = radius_m - 0.5 * std::sqrt(2.0) * part_m;
  if (within_m <= 0.0) return;
  const auto bound = [&](double at, std::int64_t from) {
    return std::clamp(static_cast<std::int64_t>(std::floor(at / part_m)) - from, std::int64_t{0},
                      side - 1);
  };
  const Vec2 margin(within_m, within_m);
  const Vec2 low = right.cwiseMax(left) - margin;
  const Vec2 high = right.cwiseMin(left) + margin;
  const std::int64_t last_row = bound(high.y(), first.row);
  const std::int64_t last_column = bound(high.x(), first.column);
  for (std::int64_t row = bound(low.y(), first.row); row <= last_row; ++row) {
    for (std::int64_t column = bound(low.x(), first.column); column <= last_column; ++column) {
      const Vec2 middle = part_m * Vec2(static_cast<double>(first.column + column) + 0.5,
                                        static_cast<double>(first.row + row) + 0.5);
      if (core::length(middle - right) < within_m && core::length(middle - left) < within_m) {
        closed_[static_cast<std::size_t>(row * side + column)] = 1;
      }
    }
  }
}

void NoRoom::keep(const Part& first, std::int64_t side) {
  for (std::int64_t i = 0; i < side * side; ++i) {
    if (closed_[static_cast<std::size_t>(i)] == 0) continue;
    const std::int64_t row = first.row + i / side;
    const std::int64_t column = first.column + i % side;
    const std::pair place{static_cast<std::int32_t>(floor_div(row)),
                          static_cast<std::int32_t>(floor_div(column))};
    const auto found = state_.parts.find(place);
    if (found == state_.parts.end() && state_.parts.size() >= kMostCells) continue;
    const std::int64_t bit = (row - kParts * place.first) * kParts + column - kParts * place.second;
    std::uint64_t& parts = found == state_.parts.end() ? state_.parts[place] : found->second;
    parts |= std::uint64_t{1} << static_cast<unsigned>(bit);
  }
}

void NoRoom::load(core::StateReader& reader) {
  reader(state_);
  if (!reader.check(state_.parts.size() <= kMostCells, "more cells without room than are kept")) {
    state_ = {};
  }
}

}  // namespace clew::map

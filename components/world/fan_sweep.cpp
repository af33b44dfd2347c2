// SPDX-License-Identifier: Apache-2.0
#include "world/fan_sweep.hpp"

#include <algorithm>
#include <cmath>

namespace clew::world {
namespace {

// An obstacle this near may be on any side: its angles are lost in rounding.
constexpr double kAtTheApex_m = 1e-6;
constexpr double kFullTurn = 2.0 * core::kPi;

}  // namespace

FanSweep::FanSweep(const RayFan& fan, const Pose2& pose, double* squared_distances)
    : fan_(fan),
      apex_(pose.position()),
      heading_(core::direction(pose.heading_rad)),
      first_rad_(pose.heading_rad + fan.bearing_first_rad()),
      squared_distances_(squared_distances) {}

void FanSweep::look(const World::Segment& segment) {
  if (distance(apex_, nearest_point(segment, apex_)) < kAtTheApex_m) {
    look(segment, 0.0, kFullTurn);
    return;
  }
  const Vec2 a{segment.a.x() - apex_.x(), segment.a.y() - apex_.y()};
  const Vec2 b{segment.b.x() - apex_.x(), segment.b.y() - apex_.y()};
  const double from_rad = core::atan2(a.y(), a.x());
  const double turn_rad = core::atan2(cross(a, b), dot(a, b));
  look(segment, std::min(from_rad, from_rad + turn_rad), std::fabs(turn_rad));
}

void FanSweep::look(const World::Circle& circle) {
  const Vec2 centre{circle.centre.x() - apex_.x(), circle.centre.y() - apex_.y()};
  const double distance_m = core::length(centre);
  if (distance_m < circle.radius_m + kAtTheApex_m) {
    look(circle, 0.0, kFullTurn);
    return;
  }
  const double half_rad = core::asin(circle.radius_m / distance_m);
  look(circle, core::atan2(centre.y(), centre.x()) - half_rad, 2.0 * half_rad);
}

/// Looks along the rays in [low_rad, low_rad + span_rad], and their neighbours. Rays are counted in
/// the fan's own sense of rotation, in which the obstacle begins somewhere in the first turn; it
/// may reach over the turn's end, to the first rays, and a full fan ends on its first ray again.
template <typename Shape>
void FanSweep::look(const Shape& shape, double low_rad, double span_rad) {
  const double step_rad = fan_.bearing_step_rad();
  const double offset_rad =
      step_rad > 0.0 ? low_rad - first_rad_ : first_rad_ - (low_rad + span_rad);
  const double begin_rad = offset_rad - kFullTurn * std::floor(offset_rad / kFullTurn);
  const double rays_a_radian = 1.0 / std::fabs(step_rad);
  const double begin = begin_rad * rays_a_radian;
  const double end = (begin_rad + span_rad) * rays_a_radian;
  const double turn = kFullTurn * rays_a_radian;
  look_along(shape, begin - turn, end - turn);
  look_along(shape, begin, end);
  look_along(shape, begin + turn, end + turn);
}

template <typename Shape>
void FanSweep::look_along(const Shape& shape, double first, double last) {
  const double from = std::max(std::floor(first), 0.0);
  const double to = std::min(std::ceil(last), static_cast<double>(fan_.size()) - 1.0);
  if (!(from <= to)) return;
  const auto end = static_cast<std::size_t>(to) + 1;
  for (auto i = static_cast<std::size_t>(from); i < end; ++i) {
    const Cone ray(apex_, ConeDirection{fan_.axis(i), Vec2::UnitX()}.turned(heading_));
    double& nearest = squared_distances_[i];
    nearest = std::min(nearest, ray.squared_distance(shape, nearest));
  }
}

}  // namespace clew::world

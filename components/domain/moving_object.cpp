// SPDX-License-Identifier: Apache-2.0
#include "domain/moving_object.hpp"

#include <algorithm>
#include <cmath>

#include "domain/landmark_classes.hpp"

namespace clew::domain {
namespace {

constexpr double kColumn_rad = 2.0 * core::kPi / MovingObject::kColumns;

/// What a class counts in a scan that sees this far.
double class_m(double range_max_m) { return 2.0 * range_max_m / kLastClass; }

}  // namespace

const char* object_motion_name(ObjectMotion motion) {
  switch (motion) {
    case ObjectMotion::kStatic:
      return "static";
    case ObjectMotion::kApproaching:
      return "approaching";
    case ObjectMotion::kReceding:
      return "receding";
    case ObjectMotion::kCrossingLeft:
      return "crossing left";
    case ObjectMotion::kCrossingRight:
      break;
  }
  return "crossing right";
}

core::Vec2 MovingObject::velocity_robot_mps(double robot_radius_m) const {
  if (motion == ObjectMotion::kStatic) return core::Vec2::Zero();
  std::array<double, 3> squares{};
  for (std::size_t i = 0; i < 3; ++i) {
    squares[i] = (ranges_m[i] + robot_radius_m) * (ranges_m[i] + robot_radius_m);
  }
  const double step_s = kPatternStep_s;
  const double speed_squared =
      std::max(0.0, squares[0] - 2.0 * squares[1] + squares[2]) / (2.0 * step_s * step_s);
  const double slope = (squares[0] - 4.0 * squares[1] + 3.0 * squares[2]) / (2.0 * step_s);
  const double distance_m = std::max(ranges_m[2] + robot_radius_m, 1e-3);
  const double speed_mps = std::sqrt(speed_squared);
  const double away_mps = std::clamp(0.5 * slope / distance_m, -speed_mps, speed_mps);
  const core::Vec2 sight = core::direction(bearing_rad);
  if (motion == ObjectMotion::kApproaching || motion == ObjectMotion::kReceding) {
    return (away_mps < 0.0 ? -speed_mps : speed_mps) * sight;
  }
  const double side = motion == ObjectMotion::kCrossingLeft ? 1.0 : -1.0;
  const double across_mps = side * std::sqrt(speed_squared - away_mps * away_mps);
  return away_mps * sight + across_mps * core::Vec2(-sight.y(), sight.x());
}

Recognition to_recognition(const MovingObject& object, double range_max_m) {
  Recognition recognition;
  recognition.network = Network::kSom;
  const double from_behind_rad = core::wrap_angle_rad(object.bearing_rad) + core::kPi;
  const auto column = static_cast<std::uint32_t>(from_behind_rad / kColumn_rad);
  recognition.neuron = static_cast<std::uint32_t>(object.motion) * MovingObject::kColumns +
                       std::min(column, MovingObject::kColumns - 1);
  for (std::size_t i = 0; i < 3; ++i) {
    const double classes = object.ranges_m[i] / class_m(range_max_m);
    recognition.prototype_classes[i] = std::clamp(classes, 0.0, static_cast<double>(kLastClass));
  }
  return recognition;
}

std::optional<MovingObject> to_moving_object(const Recognition& recognition, double range_max_m) {
  if (recognition.neuron >= kObjectMotions * MovingObject::kColumns) return std::nullopt;
  MovingObject object;
  object.motion = static_cast<ObjectMotion>(recognition.neuron / MovingObject::kColumns);
  const double column = static_cast<double>(recognition.neuron % MovingObject::kColumns);
  object.bearing_rad = core::wrap_angle_rad((column + 0.5) * kColumn_rad - core::kPi);
  for (std::size_t i = 0; i < 3; ++i) {
    object.ranges_m[i] = recognition.prototype_classes[i] * class_m(range_max_m);
  }
  return object;
}

}  // namespace clew::domain

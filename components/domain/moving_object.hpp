// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/geometry.hpp"
#include "domain/messages.hpp"

namespace clew::domain {

/// What an object does, as the robot sees it: Krishna & Kalra 2000, section 5, the outlook.
enum class ObjectMotion : std::uint8_t {
  kStatic,
  kApproaching,
  kReceding,
  kCrossingLeft,  ///< from the robot's right to its left
  kCrossingRight
};

inline constexpr std::uint32_t kObjectMotions = 5;

/// `approaching`, `crossing left`
const char* object_motion_name(ObjectMotion motion);

/// An object that was recognised by a sequence of range patterns. Topic `landmark` carries up to
/// four of them as recognitions in samples in which no landmark vector was presented.
///
/// The recognition's neuron is one of a lattice with a row for each motion and a column for each
/// degree of bearing. Its three classes are the ranges of the pattern, in sixteenths of how far the
/// sensor sees: 8 is twice as far.
struct MovingObject {
  static constexpr std::uint32_t kColumns = 360;
  /// From one range of the pattern to the next.
  static constexpr double kPatternStep_s = 0.5;

  ObjectMotion motion = ObjectMotion::kStatic;
  double bearing_rad = 0.0;  ///< of its centre, from the heading
  /// From where the robot is now to where the object's centre was a second ago, half a second ago
  /// and is now; less the robot's radius, at least 0.
  std::array<double, 3> ranges_m{};

  /// How it moves over ground, in the robot's frame. The square of the distance of what moves
  /// steadily is a parabola in time, so that the three ranges give its speed, and its speed along
  /// the line of sight; the class tells the side of the rest. What approaches or recedes is taken
  /// to do so straight.
  core::Vec2 velocity_robot_mps(double robot_radius_m) const;
};

Recognition to_recognition(const MovingObject& object, double range_max_m);

/// The object that a recognition tells of; nothing if its neuron is beyond the lattice.
std::optional<MovingObject> to_moving_object(const Recognition& recognition, double range_max_m);

}  // namespace clew::domain

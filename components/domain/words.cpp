// SPDX-License-Identifier: Apache-2.0
#include "domain/words.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/angle.hpp"

namespace clew::domain {
namespace {

// What rounds to nothing is none.
constexpr double kNone_rad = core::radians(0.5);

/// `15 degrees left`, or `15 degrees/s left` with the unit's end `/s`.
std::string say_turn(double turn_rad, const char* per) {
  return fmt::format("{}{} {}", say_degrees(turn_rad), per, turn_rad < 0.0 ? "right" : "left");
}

}  // namespace

std::string say_metres(double value_m) { return fmt::format("{:.2f} m", value_m); }

std::string say_degrees(double angle_rad) {
  const std::string degrees = fmt::format("{:.0f}", std::fabs(core::degrees(angle_rad)));
  return degrees + (degrees == "1" ? " degree" : " degrees");
}

std::string say_bearing(double bearing_rad) {
  const double wrapped_rad = core::wrap_angle_rad(bearing_rad);
  if (std::fabs(wrapped_rad) < kNone_rad) return "straight ahead";
  if (std::fabs(wrapped_rad) > core::kPi - kNone_rad) return "straight behind";
  return say_turn(wrapped_rad, "");
}

std::string say_percent(double ratio) { return fmt::format("{:.0f} %", 100.0 * ratio); }

std::string say_seconds(double value_s) { return fmt::format("{:.1f} s", value_s); }

std::string say_number(double value) { return fmt::format("{:.2f}", value); }

std::string say_count(std::size_t count, const std::string& thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

std::string say_place(const core::Vec2& place) {
  return fmt::format("({:.2f}, {:.2f})", place.x(), place.y());
}

std::string say_motion(const Motion& motion) {
  switch (motion.kind) {
    case CommandKind::kStop:
      return "stop";
    case CommandKind::kGiveUp:
      return "give up";
    case CommandKind::kTurnAndStep: {
      const bool turns = std::fabs(motion.turn_rad) >= kNone_rad;
      const std::string turn = turns ? "turn " + say_turn(motion.turn_rad, "") : "";
      if (motion.step_m == 0.0) return turns ? turn + " on the spot" : "stay";
      return (turns ? turn + " and step " : "step ") + say_metres(motion.step_m) +
             (turns ? "" : " straight ahead");
    }
    case CommandKind::kVelocities: {
      const std::string speed = fmt::format("drive at {:.2f} m/s", motion.speed_mps);
      if (std::fabs(motion.turn_rate_radps) < kNone_rad) return speed;
      return speed + ", turning " + say_turn(motion.turn_rate_radps, "/s");
    }
    case CommandKind::kWheelSpeeds:
      return fmt::format("run the left wheel at {:.2f} m/s and the right one at {:.2f} m/s",
                         motion.left_mps, motion.right_mps);
  }
  return "do something unknown";
}

}  // namespace clew::domain

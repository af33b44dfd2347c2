// SPDX-License-Identifier: Apache-2.0
#include "domain/field_check.hpp"
#include "domain/landmark_classes.hpp"
#include "domain/topics.hpp"

namespace clew::domain {
namespace {

constexpr double kFullTurn = 2.0 * core::kPi;

void check_stamp(FieldCheck& check, const TickStamp& stamp) {
  check.not_negative({"stamp", "sim_time_s"}, stamp.sim_time_s);
}

void check_pose(FieldCheck& check, const char* name, const Pose2& pose) {
  check.finite({name, "x_m"}, pose.x_m);
  check.finite({name, "y_m"}, pose.y_m);
  check.wrapped_angle({name, "heading_rad"}, pose.heading_rad);
}

void check_motion(FieldCheck& check, const char* name, const Motion& m) {
  const auto number = [&](const char* member, double value, CommandKind user, double bound) {
    if (m.kind == user) {
      check.in_range({name, member}, value, -bound, bound);
    } else {
      check.unused({name, member}, value);
    }
  };
  check.enumerator({name, "kind"}, m.kind, CommandKind::kGiveUp);
  number("turn_rad", m.turn_rad, CommandKind::kTurnAndStep, core::kPi);
  number("step_m", m.step_m, CommandKind::kTurnAndStep, FieldCheck::kLargest);
  number("speed_mps", m.speed_mps, CommandKind::kVelocities, FieldCheck::kLargest);
  number("turn_rate_radps", m.turn_rate_radps, CommandKind::kVelocities, FieldCheck::kLargest);
  number("left_mps", m.left_mps, CommandKind::kWheelSpeeds, FieldCheck::kLargest);
  number("right_mps", m.right_mps, CommandKind::kWheelSpeeds, FieldCheck::kLargest);
}

void check_entry(FieldCheck& check, std::size_t i, const EventEntry& entry) {
  const char* const list = "entries";
  check.enumerator({list, i, "kind"}, entry.kind, EventKind::kUnreachable);
  check.text({list, i, "rule"}, entry.rule, kMaxNameLength);
  check.finite({list, i, "x_m"}, entry.x_m);
  check.finite({list, i, "y_m"}, entry.y_m);
  check.finite({list, i, "earlier_x_m"}, entry.earlier_x_m);
  check.finite({list, i, "earlier_y_m"}, entry.earlier_y_m);
  check.not_negative({list, i, "travel_m"}, entry.travel_m);
  check.text({list, i, "text"}, entry.text, kMaxTextLength);
}

}  // namespace

core::Result<void> validate(const Command& m) {
  FieldCheck check(Topic::kCommand);
  check_stamp(check, m.stamp);
  check_motion(check, "motion", m.motion);
  return check.result();
}

core::Result<void> validate(const Event& m) {
  FieldCheck check(Topic::kEvent);
  check_stamp(check, m.stamp);
  for (std::size_t i = 0; i < m.entries.size(); ++i) check_entry(check, i, m.entries[i]);
  return check.result();
}

core::Result<void> validate(const Guidance& m) {
  FieldCheck check(Topic::kGuidance);
  check_stamp(check, m.stamp);
  check.finite({"target_x_m"}, m.target_x_m);
  check.finite({"target_y_m"}, m.target_y_m);
  check.enumerator({"mode"}, m.mode, GuidanceMode::kUnreachable);
  check_motion(check, "override_motion", m.override_motion);
  for (std::size_t i = 0; i < m.virtual_obstacles.size(); ++i) {
    const VirtualObstacle& box = m.virtual_obstacles[i];
    check.finite({"virtual_obstacles", i, "x_max_m"}, box.x_max_m);
    check.finite({"virtual_obstacles", i, "y_max_m"}, box.y_max_m);
    check.in_range({"virtual_obstacles", i, "x_min_m"}, box.x_min_m, -FieldCheck::kLargest,
                   box.x_max_m);
    check.in_range({"virtual_obstacles", i, "y_min_m"}, box.y_min_m, -FieldCheck::kLargest,
                   box.y_max_m);
  }
  check.text({"why"}, m.why, kMaxTextLength);
  return check.result();
}

core::Result<void> validate(const Landmark& m) {
  FieldCheck check(Topic::kLandmark);
  check_stamp(check, m.stamp);
  check.at_most({"spatial_class"}, m.spatial_class, kLastClass);
  for (std::size_t i = 0; i < m.classes.size(); ++i) {
    check.at_most({"classes", i}, m.classes[i], kLastClass);
  }
  for (std::size_t i = 0; i < m.recognitions.size(); ++i) {
    check.enumerator({"recognitions", i, "network"}, m.recognitions[i].network, Network::kFuzzyArt);
    for (const double prototype_class : m.recognitions[i].prototype_classes) {
      check.in_range({"recognitions", i, "prototype_classes"}, prototype_class, 0.0, kLastClass);
    }
  }
  return check.result();
}

core::Result<void> validate(const Odometry& m) {
  FieldCheck check(Topic::kOdometry);
  check_stamp(check, m.stamp);
  check_pose(check, "pose_odom_robot", m.pose_odom_robot);
  check.finite({"speed_mps"}, m.speed_mps);
  check.finite({"turn_rate_radps"}, m.turn_rate_radps);
  check.not_negative({"travel_m"}, m.travel_m);
  for (std::size_t i = 0; i < m.contact_bearings_rad.size(); ++i) {
    check.wrapped_angle({"contact_bearings_rad", i}, m.contact_bearings_rad[i]);
  }
  return check.result();
}

core::Result<void> validate(const Scan& m) {
  FieldCheck check(Topic::kScan);
  check_stamp(check, m.stamp);
  check.in_range({"bearing_first_rad"}, m.bearing_first_rad, -kFullTurn, kFullTurn);
  check.in_range({"bearing_step_rad"}, m.bearing_step_rad, -kFullTurn, kFullTurn);
  check.in_range({"beam_width_rad"}, m.beam_width_rad, 0.0, kFullTurn);
  check.not_negative({"range_max_m"}, m.range_max_m);
  check.in_range({"range_min_m"}, m.range_min_m, 0.0, m.range_max_m);
  check.size({"ranges_m"}, m.ranges_m.size(), kMaxRanges);
  for (std::size_t i = 0; i < m.ranges_m.size(); ++i) {
    check.in_range({"ranges_m", i}, m.ranges_m[i], 0.0, m.range_max_m);
  }
  return check.result();
}

core::Result<void> validate(const State& m) {
  FieldCheck check(Topic::kState);
  check_stamp(check, m.stamp);
  check_pose(check, "pose_world_robot", m.pose_world_robot);
  check.finite({"speed_mps"}, m.speed_mps);
  check.finite({"turn_rate_radps"}, m.turn_rate_radps);
  check.not_negative({"path_length_m"}, m.path_length_m);
  check.enumerator({"outcome"}, m.outcome, Outcome::kTimeout);
  return check.result();
}

core::Result<void> validate(const Target& m) {
  FieldCheck check(Topic::kTarget);
  check_stamp(check, m.stamp);
  check.finite({"x_m"}, m.x_m);
  check.finite({"y_m"}, m.y_m);
  check.not_negative({"radius_m"}, m.radius_m);
  return check.result();
}

}  // namespace clew::domain

// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "domain/topics.hpp"

namespace clew::domain {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A way to spoil a good message, and what the refusal must say.
template <typename Message>
struct Fault {
  std::string message;
  std::function<void(Message&)> spoil;
};

template <typename Message>
void expect_refused(const Message& good, const std::vector<Fault<Message>>& faults) {
  ASSERT_TRUE(validate(good).ok()) << validate(good).error().text();
  for (const Fault<Message>& fault : faults) {
    Message bad = good;
    fault.spoil(bad);

    const core::Result<void> result = validate(bad);

    ASSERT_FALSE(result.ok()) << fault.message;
    EXPECT_EQ(result.error().text(), fault.message);
  }
}

Command turn_and_step() {
  Command command;
  command.motion.kind = CommandKind::kTurnAndStep;
  command.motion.turn_rad = -0.5;
  command.motion.step_m = 0.25;
  return command;
}

TEST(Validate, RefusesTimeBeforeTheStart) {
  expect_refused<Target>(Target{},
                         {{"target: stamp.sim_time_s is -0.1; allowed: finite numbers from 0",
                           [](Target& m) { m.stamp.sim_time_s = -0.1; }},
                          {"target: stamp.sim_time_s is nan; allowed: finite numbers from 0",
                           [](Target& m) { m.stamp.sim_time_s = kNan; }}});
}

TEST(Validate, RefusesABadCommand) {
  expect_refused<Command>(
      turn_and_step(),
      {{"command: motion.kind is 5; allowed: at most 4",
        [](Command& m) {
          m.motion = Motion{};
          m.motion.kind = static_cast<CommandKind>(5);
        }},
       {"command: motion.turn_rad is 3.2; allowed: -3.141592653589793 to 3.141592653589793",
        [](Command& m) { m.motion.turn_rad = 3.2; }},
       {"command: motion.step_m is inf; allowed: finite numbers",
        [](Command& m) { m.motion.step_m = kInfinity; }},
       {"command: motion.left_mps is 0.1; allowed: 0, since the kind does not use it",
        [](Command& m) { m.motion.left_mps = 0.1; }},
       {"command: motion.speed_mps is nan; allowed: 0, since the kind does not use it",
        [](Command& m) { m.motion.speed_mps = kNan; }}});
}

TEST(Validate, AcceptsTheNumbersOfEachKindOfMotion) {
  Command velocities;
  velocities.motion.kind = CommandKind::kVelocities;
  velocities.motion.speed_mps = 0.4;
  velocities.motion.turn_rate_radps = -7.0;
  Command wheels;
  wheels.motion.kind = CommandKind::kWheelSpeeds;
  wheels.motion.left_mps = -0.1;
  wheels.motion.right_mps = 0.2;

  EXPECT_TRUE(validate(velocities).ok());
  EXPECT_TRUE(validate(wheels).ok());
}

TEST(Validate, RefusesABadEvent) {
  Event good;
  good.entries.resize(2);
  good.entries[1].rule = std::string(kMaxNameLength, 'r');
  good.entries[1].text = std::string(kMaxTextLength, 't');

  expect_refused<Event>(
      good, {{"event: entries[1].kind is 8; allowed: at most 7",
              [](Event& m) { m.entries[1].kind = static_cast<EventKind>(8); }},
             {"event: entries[1].rule is 49 bytes long; allowed: at most 48",
              [](Event& m) { m.entries[1].rule += 'r'; }},
             {"event: entries[1].text is 97 bytes long; allowed: at most 96",
              [](Event& m) { m.entries[1].text += 't'; }},
             {"event: entries[0].text is a text with a zero byte; allowed: none, since that ends a "
              "string in CDR",
              [](Event& m) { m.entries[0].text = std::string("a\0b", 3); }},
             {"event: entries[0].x_m is nan; allowed: finite numbers",
              [](Event& m) { m.entries[0].x_m = kNan; }},
             {"event: entries[0].y_m is inf; allowed: finite numbers",
              [](Event& m) { m.entries[0].y_m = kInfinity; }},
             {"event: entries[0].earlier_x_m is nan; allowed: finite numbers",
              [](Event& m) { m.entries[0].earlier_x_m = kNan; }},
             {"event: entries[0].earlier_y_m is nan; allowed: finite numbers",
              [](Event& m) { m.entries[0].earlier_y_m = kNan; }},
             {"event: entries[0].travel_m is -1; allowed: finite numbers from 0",
              [](Event& m) { m.entries[0].travel_m = -1.0; }}});
}

TEST(Validate, RefusesBadGuidance) {
  Guidance good;
  good.virtual_obstacles.push_back({-1.0, -2.0, -1.0, 3.0});
  good.why = std::string(kMaxTextLength, 'w');

  expect_refused<Guidance>(
      good,
      {{"guidance: target_x_m is nan; allowed: finite numbers",
        [](Guidance& m) { m.target_x_m = kNan; }},
       {"guidance: target_y_m is -inf; allowed: finite numbers",
        [](Guidance& m) { m.target_y_m = -kInfinity; }},
       {"guidance: mode is 3; allowed: at most 2",
        [](Guidance& m) { m.mode = static_cast<GuidanceMode>(3); }},
       {"guidance: override_motion.turn_rad is nan; allowed: 0, since the kind does not use it",
        [](Guidance& m) { m.override_motion.turn_rad = kNan; }},
       {"guidance: virtual_obstacles[0].x_min_m is -0.5; allowed: finite numbers up to -1",
        [](Guidance& m) { m.virtual_obstacles[0].x_min_m = -0.5; }},
       {"guidance: virtual_obstacles[0].y_min_m is nan; allowed: finite numbers up to 3",
        [](Guidance& m) { m.virtual_obstacles[0].y_min_m = kNan; }},
       {"guidance: virtual_obstacles[0].x_max_m is inf; allowed: finite numbers",
        [](Guidance& m) { m.virtual_obstacles[0].x_max_m = kInfinity; }},
       {"guidance: virtual_obstacles[0].y_max_m is nan; allowed: finite numbers",
        [](Guidance& m) { m.virtual_obstacles[0].y_max_m = kNan; }},
       {"guidance: why is 97 bytes long; allowed: at most 96", [](Guidance& m) { m.why += 'w'; }}});
}

TEST(Validate, RefusesABadLandmark) {
  Landmark good;
  good.classes = {0, 4, 8};
  good.recognitions.resize(1);
  good.recognitions[0].prototype_classes = {0.0, 3.7, 8.0};

  expect_refused<Landmark>(
      good,
      {{"landmark: spatial_class is 9; allowed: at most 8",
        [](Landmark& m) { m.spatial_class = 9; }},
       {"landmark: classes[2] is 9; allowed: at most 8", [](Landmark& m) { m.classes[2] = 9; }},
       {"landmark: recognitions[0].network is 2; allowed: at most 1",
        [](Landmark& m) { m.recognitions[0].network = static_cast<Network>(2); }},
       {"landmark: recognitions[0].prototype_classes[1] is 8.5; allowed: 0 to 8",
        [](Landmark& m) { m.recognitions[0].prototype_classes[1] = 8.5; }}});
}

TEST(Validate, RefusesBadOdometry) {
  Odometry good;
  good.pose_odom_robot = {1.0, 2.0, core::kPi};
  good.contact_bearings_rad.push_back(0.3);

  expect_refused<Odometry>(
      good,
      {{"odometry: pose_odom_robot.x_m is nan; allowed: finite numbers",
        [](Odometry& m) { m.pose_odom_robot.x_m = kNan; }},
       {"odometry: pose_odom_robot.y_m is inf; allowed: finite numbers",
        [](Odometry& m) { m.pose_odom_robot.y_m = kInfinity; }},
       {"odometry: pose_odom_robot.heading_rad is -3.141592653589793; allowed: above -pi and at "
        "most pi",
        [](Odometry& m) { m.pose_odom_robot.heading_rad = -core::kPi; }},
       {"odometry: speed_mps is nan; allowed: finite numbers",
        [](Odometry& m) { m.speed_mps = kNan; }},
       {"odometry: turn_rate_radps is nan; allowed: finite numbers",
        [](Odometry& m) { m.turn_rate_radps = kNan; }},
       {"odometry: travel_m is -2; allowed: finite numbers from 0",
        [](Odometry& m) { m.travel_m = -2.0; }},
       {"odometry: contact_bearings_rad[0] is 3.5; allowed: above -pi and at most pi",
        [](Odometry& m) { m.contact_bearings_rad[0] = 3.5; }}});
}

TEST(Validate, RefusesABadScan) {
  Scan good;
  good.range_min_m = 0.1;
  good.range_max_m = 1.5;
  good.ranges_m = {0.0, 0.7, 1.5};

  expect_refused<Scan>(
      good,
      {{"scan: bearing_first_rad is -7; allowed: -6.283185307179586 to 6.283185307179586",
        [](Scan& m) { m.bearing_first_rad = -7.0; }},
       {"scan: bearing_step_rad is nan; allowed: -6.283185307179586 to 6.283185307179586",
        [](Scan& m) { m.bearing_step_rad = kNan; }},
       {"scan: beam_width_rad is -0.1; allowed: 0 to 6.283185307179586",
        [](Scan& m) { m.beam_width_rad = -0.1; }},
       {"scan: range_max_m is inf; allowed: finite numbers from 0",
        [](Scan& m) { m.range_max_m = kInfinity; }},
       {"scan: range_min_m is 1.6; allowed: 0 to 1.5", [](Scan& m) { m.range_min_m = 1.6; }},
       {"scan: ranges_m is 2049 values long; allowed: at most 2048",
        [](Scan& m) { m.ranges_m.assign(kMaxRanges + 1, 1.0); }},
       {"scan: ranges_m[1] is 1.6; allowed: 0 to 1.5", [](Scan& m) { m.ranges_m[1] = 1.6; }},
       {"scan: ranges_m[2] is nan; allowed: 0 to 1.5", [](Scan& m) { m.ranges_m[2] = kNan; }}});
}

TEST(Validate, RefusesABadState) {
  expect_refused<State>(State{}, {{"state: pose_world_robot.x_m is nan; allowed: finite numbers",
                                   [](State& m) { m.pose_world_robot.x_m = kNan; }},
                                  {"state: speed_mps is inf; allowed: finite numbers",
                                   [](State& m) { m.speed_mps = kInfinity; }},
                                  {"state: turn_rate_radps is nan; allowed: finite numbers",
                                   [](State& m) { m.turn_rate_radps = kNan; }},
                                  {"state: path_length_m is -1; allowed: finite numbers from 0",
                                   [](State& m) { m.path_length_m = -1.0; }},
                                  {"state: outcome is 5; allowed: at most 4",
                                   [](State& m) { m.outcome = static_cast<Outcome>(5); }}});
}

TEST(Validate, RefusesABadTarget) {
  expect_refused<Target>(
      Target{},
      {{"target: x_m is nan; allowed: finite numbers", [](Target& m) { m.x_m = kNan; }},
       {"target: y_m is inf; allowed: finite numbers", [](Target& m) { m.y_m = kInfinity; }},
       {"target: radius_m is -0.2; allowed: finite numbers from 0",
        [](Target& m) { m.radius_m = -0.2; }},
       {"target: heading_rad is 4; allowed: above -pi and at most pi",
        [](Target& m) { m.heading_rad = 4.0; }},
       {"target: heading_tolerance_rad is -0.1; allowed: 0 to 3.141592653589793",
        [](Target& m) { m.heading_tolerance_rad = -0.1; }},
       {"target: waypoint is 3; allowed: at most 2", [](Target& m) {
          m.waypoint = 3;
          m.waypoints = 2;
        }}});
}

TEST(Validate, RefusesACovarianceThatIsNone) {
  Odometry good;
  good.covariance = {0.04, 0.02, 0.01, 0.01, 0.0, 0.0025};
  expect_refused<Odometry>(
      good, {{"odometry: covariance.x_m2 is -1; allowed: finite numbers from 0",
              [](Odometry& m) { m.covariance.x_m2 = -1.0; }},
             {"odometry: covariance.y_m2 is inf; allowed: finite numbers from 0",
              [](Odometry& m) { m.covariance.y_m2 = kInfinity; }},
             {"odometry: covariance.heading_rad2 is nan; allowed: finite numbers from 0",
              [](Odometry& m) { m.covariance.heading_rad2 = kNan; }},
             // The root of 0.04 * 0.01 is 0.02, and 1e-6 of it and 1e-9 are left to rounding.
             {"odometry: covariance.xy_m2 is 0.021; allowed: -0.020000021 to 0.020000021",
              [](Odometry& m) { m.covariance.xy_m2 = 0.021; }},
             {"odometry: covariance.y_heading_m_rad is nan; allowed: -0.005000006 to 0.005000006",
              [](Odometry& m) { m.covariance.y_heading_m_rad = kNan; }}});
}

}  // namespace
}  // namespace clew::domain

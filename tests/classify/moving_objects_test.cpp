// SPDX-License-Identifier: Apache-2.0
#include "classify/moving_objects.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>

namespace clew::classify {
namespace {

using core::Vec2;
using domain::MovingObject;
using domain::ObjectMotion;

constexpr double kTick_s = 0.1;
constexpr double kRobot_m = 0.15;
constexpr double kRange_m = 4.0;
constexpr double kDisc_m = 0.25;
constexpr int kBeams = 361;

/// How far a ray from the origin goes before it hits a disc of kDisc_m; nothing if it passes by.
std::optional<double> hit_m(double bearing_rad, const Vec2& centre) {
  const Vec2 ray(std::cos(bearing_rad), std::sin(bearing_rad));
  const double along_m = ray.dot(centre);
  const double off_squared = centre.squaredNorm() - along_m * along_m;
  if (along_m <= 0.0 || off_squared >= kDisc_m * kDisc_m) return std::nullopt;
  return along_m - std::sqrt(kDisc_m * kDisc_m - off_squared);
}

/// A laser over 180 degrees that sees discs, and a wall x = wall_m ahead in the frame of odometry.
domain::Scan scan_of(const std::vector<Vec2>& discs_odom, const core::Pose2& pose, double wall_m) {
  domain::Scan scan;
  scan.bearing_first_rad = 0.5 * core::kPi;
  scan.bearing_step_rad = -core::kPi / (kBeams - 1);
  scan.range_max_m = kRange_m;
  for (int i = 0; i < kBeams; ++i) {
    const double bearing_rad = scan.bearing_rad(static_cast<std::size_t>(i));
    double nearest_m = kRange_m + kRobot_m;
    const double ahead = std::cos(bearing_rad + pose.heading_rad);
    if (ahead > 0.0) nearest_m = std::min(nearest_m, (wall_m - pose.x_m) / ahead);
    for (const Vec2& disc : discs_odom) {
      const Vec2 off = disc - pose.position();
      const double c = std::cos(pose.heading_rad);
      const double s = std::sin(pose.heading_rad);
      const Vec2 seen(c * off.x() + s * off.y(), c * off.y() - s * off.x());
      if (const auto hit = hit_m(bearing_rad, seen)) nearest_m = std::min(nearest_m, *hit);
    }
    scan.ranges_m.push_back(std::max(0.0, nearest_m - kRobot_m));
  }
  return scan;
}

/// A robot and discs that move, each as a function of time.
struct Scene {
  std::function<core::Pose2(double)> robot = [](double) { return core::Pose2{}; };
  std::vector<std::function<Vec2(double)>> discs;
  double wall_m = 100.0;
};

void step(MovingObjects& classifier, const Scene& scene, std::uint64_t tick,
          domain::Landmark& landmark) {
  const double time_s = static_cast<double>(tick) * kTick_s;
  domain::Odometry odometry;
  odometry.stamp.tick = tick;
  odometry.pose_odom_robot = scene.robot(time_s);
  std::vector<Vec2> discs;
  for (const auto& disc : scene.discs) discs.push_back(disc(time_s));
  landmark = {};
  classifier.step(odometry, scan_of(discs, odometry.pose_odom_robot, scene.wall_m), landmark);
}

/// What is recognised after a second and a half.
std::vector<MovingObject> recognised(const Scene& scene) {
  MovingObjects classifier({}, kRobot_m, kTick_s);
  domain::Landmark landmark;
  for (std::uint64_t tick = 0; tick <= 15; ++tick) step(classifier, scene, tick, landmark);
  EXPECT_FALSE(landmark.presented);
  std::vector<MovingObject> objects;
  for (const domain::Recognition& recognition : landmark.recognitions) {
    objects.push_back(domain::to_moving_object(recognition, kRange_m).value());
  }
  return objects;
}

std::function<Vec2(double)> line(const Vec2& from, const Vec2& velocity_mps) {
  return [=](double time_s) { return Vec2(from + time_s * velocity_mps); };
}

TEST(MovingObjects, ADiscThatComesStraightApproaches) {
  Scene scene;
  scene.discs = {line({3.0, 0.0}, {-0.6, 0.0})};

  const auto objects = recognised(scene);

  // After 1.5 s its centre is 3.0 - 0.9 m away, and was 0.3 and 0.6 m farther: from the skin.
  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(objects[0].motion, ObjectMotion::kApproaching);
  EXPECT_NEAR(objects[0].bearing_rad, 0.0, core::radians(1.0));
  EXPECT_NEAR(objects[0].ranges_m[2], 2.1 - kRobot_m, 0.05);
  EXPECT_NEAR(objects[0].ranges_m[1], 2.4 - kRobot_m, 0.05);
  EXPECT_NEAR(objects[0].ranges_m[0], 2.7 - kRobot_m, 0.05);
  EXPECT_NEAR(objects[0].velocity_robot_mps(kRobot_m).x(), -0.6, 0.05);
}

TEST(MovingObjects, ADiscThatGoesAwayRecedes) {
  Scene scene;
  scene.discs = {line({1.0, 0.5}, {0.4, 0.2})};

  const auto objects = recognised(scene);

  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(objects[0].motion, ObjectMotion::kReceding);
  EXPECT_NEAR(objects[0].velocity_robot_mps(kRobot_m).norm(), std::hypot(0.4, 0.2), 0.05);
}

TEST(MovingObjects, ADiscFromRightToLeftCrossesLeft) {
  Scene scene;
  scene.discs = {line({2.0, -0.8}, {0.0, 0.6})};

  const auto objects = recognised(scene);

  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(objects[0].motion, ObjectMotion::kCrossingLeft);
  // At (2.0, 0.1) now; the three ranges and the class give its velocity.
  EXPECT_NEAR(objects[0].bearing_rad, std::atan2(0.1, 2.0), core::radians(1.5));
  EXPECT_NEAR(objects[0].velocity_robot_mps(kRobot_m).x(), 0.0, 0.06);
  EXPECT_NEAR(objects[0].velocity_robot_mps(kRobot_m).y(), 0.6, 0.06);
}

TEST(MovingObjects, ADiscFromLeftToRightCrossesRight) {
  Scene scene;
  scene.discs = {line({2.0, 0.8}, {0.0, -0.6})};

  const auto objects = recognised(scene);

  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(objects[0].motion, ObjectMotion::kCrossingRight);
  EXPECT_NEAR(objects[0].velocity_robot_mps(kRobot_m).y(), -0.6, 0.06);
}

TEST(MovingObjects, ADiscThatStandsIsStaticHoweverTheRobotMoves) {
  Scene scene;
  scene.discs = {line({2.5, 0.3}, {0.0, 0.0})};
  scene.robot = [](double time_s) { return core::Pose2{0.4 * time_s, 0.0, 0.3 * time_s}; };

  const auto objects = recognised(scene);

  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(objects[0].motion, ObjectMotion::kStatic);
  EXPECT_EQ(objects[0].velocity_robot_mps(kRobot_m), Vec2(0.0, 0.0));
}

TEST(MovingObjects, TellsMotionOverGroundWhileTheRobotMoves) {
  // The robot follows a disc that is slower than itself: the range falls, and yet it recedes.
  Scene scene;
  scene.discs = {line({2.0, 0.0}, {0.3, 0.0})};
  scene.robot = [](double time_s) { return core::Pose2{0.5 * time_s, 0.0, 0.0}; };

  const auto objects = recognised(scene);

  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(objects[0].motion, ObjectMotion::kReceding);
}

TEST(MovingObjects, AWallIsNoObject) {
  Scene scene;
  scene.wall_m = 2.0;
  scene.robot = [](double time_s) { return core::Pose2{0.4 * time_s, 0.0, 0.0}; };

  EXPECT_TRUE(recognised(scene).empty());
}

TEST(MovingObjects, AWallThatComesIntoRangeIsNoObject) {
  // At first only a short piece of it is within range, and its ends move as the robot comes near.
  Scene scene;
  scene.wall_m = kRange_m + kRobot_m + 0.1;
  scene.robot = [](double time_s) { return core::Pose2{0.4 * time_s, 0.0, 0.0}; };

  EXPECT_TRUE(recognised(scene).empty());
}

TEST(MovingObjects, ADiscBeforeAWallIsSeenWhole) {
  Scene scene;
  scene.wall_m = 3.0;
  scene.discs = {line({2.0, -0.8}, {0.0, 0.6})};

  const auto objects = recognised(scene);

  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(objects[0].motion, ObjectMotion::kCrossingLeft);
}

TEST(MovingObjects, TheNearestMoverComesFirstAndWhatStandsLast) {
  Scene scene;
  scene.discs = {line({1.0, 0.9}, {0.0, 0.0}), line({3.4, -0.5}, {-0.5, 0.0}),
                 line({2.0, -1.5}, {0.0, 0.5})};

  const auto objects = recognised(scene);

  ASSERT_EQ(objects.size(), 3u);
  EXPECT_EQ(objects[0].motion, ObjectMotion::kCrossingLeft);
  EXPECT_EQ(objects[1].motion, ObjectMotion::kApproaching);
  EXPECT_EQ(objects[2].motion, ObjectMotion::kStatic);
}

TEST(MovingObjects, TheBeginningTellsNothing) {
  // Half a window, 0.5 s, and three sightings are the least: the first answer is that of tick 5.
  Scene scene;
  scene.discs = {line({3.0, 0.0}, {-0.6, 0.0})};
  MovingObjects classifier({}, kRobot_m, kTick_s);
  domain::Landmark landmark;

  for (std::uint64_t tick = 0; tick <= 4; ++tick) {
    step(classifier, scene, tick, landmark);
    EXPECT_TRUE(landmark.recognitions.empty()) << tick;
  }
  step(classifier, scene, 5, landmark);
  EXPECT_EQ(landmark.recognitions.size(), 1u);
}

TEST(MovingObjects, ForgetsWhatIsGone) {
  Scene scene;
  scene.discs = {line({3.0, 0.0}, {-0.6, 0.0})};
  MovingObjects classifier({}, kRobot_m, kTick_s);
  domain::Landmark landmark;
  for (std::uint64_t tick = 0; tick <= 10; ++tick) step(classifier, scene, tick, landmark);

  scene.discs.clear();
  // lost_s is 0.6 s: six ticks later it is still believed to be there, one more and it is not.
  for (std::uint64_t tick = 11; tick <= 16; ++tick) step(classifier, scene, tick, landmark);
  EXPECT_EQ(landmark.recognitions.size(), 1u);
  step(classifier, scene, 17, landmark);
  EXPECT_TRUE(landmark.recognitions.empty());
}

TEST(MovingObjects, RefusesBeamsThatAreTooFarApart) {
  domain::BehaviourSetup setup;
  setup.scan = {"sonar_ring", 16, core::kPi, -core::radians(22.5), core::radians(25.0), 2.54};

  const auto made = MovingObjects::create({}, setup);

  ASSERT_FALSE(made.ok());
  EXPECT_NE(made.error().text().find("classify moving_objects needs"), std::string::npos)
      << made.error().text();
}

}  // namespace
}  // namespace clew::classify

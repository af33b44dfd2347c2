// SPDX-License-Identifier: Apache-2.0
#include "recover/escapes/right_of_way.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "tests/recover/scene.hpp"

namespace clew::recover {
namespace {

domain::BehaviourSetup setup_of(std::uint32_t robot_index) {
  domain::BehaviourSetup setup;
  setup.tick_s = 0.5;
  setup.robot_index = robot_index;
  return setup;
}

/// Drives ahead for `length_m` along y = 0.
void drive(RightOfWay& escape, double length_m) {
  for (int i = 0; i <= static_cast<int>(length_m / 0.1 + 0.5); ++i) {
    escape.watch(Scene().tick(static_cast<std::uint64_t>(i)).at(0.1 * i, 0, 0).situation());
  }
}

TEST(RightOfWay, TheLowestIndexHasTheWay) {
  RightOfWay escape({}, setup_of(0));
  drive(escape, 2.0);
  const Scene scene = Scene().tick(30).at(2, 0, 0);
  escape.begin(scene.situation(), {});
  domain::Guidance guidance;
  EXPECT_EQ(escape.step(scene.situation(), guidance), EscapeStatus::kEnded);
  EXPECT_FALSE(guidance.has_override);
}

/// A robot that cannot go aside goes back along its trail to where that began, and holds there.
double held_s(std::uint32_t robot_index) {
  RightOfWay escape({}, setup_of(robot_index));
  drive(escape, 2.0);
  std::uint64_t tick = 30;
  double x_m = 2.0;
  Scene scene;
  const auto look = [&] {
    scene = Scene().tick(tick).at(x_m, 0, 180).travelled(4.0 - x_m).sees({0, 0, 0, 0, 0, 0, 0});
    return scene.situation();
  };
  escape.begin(look(), {});
  int held = 0;
  for (; tick < 1000; ++tick) {
    const Situation situation = look();
    escape.watch(situation);
    domain::Guidance guidance;
    if (escape.step(situation, guidance) != EscapeStatus::kActive) break;
    if (guidance.has_override) {
      EXPECT_EQ(guidance.override_motion.kind, domain::CommandKind::kStop);
      EXPECT_LT(x_m, 0.3);
      ++held;
    } else {
      EXPECT_TRUE(guidance.target_is_virtual);
      EXPECT_LT(guidance.target_x_m, x_m);
      x_m -= 0.1;
    }
  }
  return 0.5 * held;
}

TEST(RightOfWay, AHigherIndexGoesBackAndHoldsTheLonger) {
  const double first_s = held_s(1);
  EXPECT_NEAR(first_s, RightOfWayParameters{}.hold_s, 0.51);
  EXPECT_NEAR(held_s(3), 3.0 * first_s, 1.1);
}

/// Thirteen cones from 90 degrees left to 90 right, with a range of 3 m: what is to the left, ahead
/// (the cone in the middle) and to the right.
domain::Scan wide_scan(double left_m, double ahead_m, double right_m) {
  domain::Scan scan;
  scan.bearing_first_rad = core::radians(90.0);
  scan.bearing_step_rad = core::radians(-15.0);
  scan.beam_width_rad = core::radians(15.0);
  scan.range_max_m = 3.0;
  scan.ranges_m.assign(13, ahead_m);
  std::fill_n(scan.ranges_m.begin(), 6, left_m);
  std::fill_n(scan.ranges_m.begin() + 7, 6, right_m);
  return scan;
}

std::string bytes_of(const RightOfWay& escape) {
  core::StateWriter writer;
  escape.save(writer);
  return writer.take();
}

std::string phase_of(const RightOfWay& escape, const Situation& situation) {
  domain::Inside inside;
  escape.tell(situation, inside);
  for (const domain::InsideValue& value : inside.values.values()) {
    if (value.name == "phase") return std::get<std::string>(value.value);
  }
  return {};
}

/// The first virtual target that is not on the way back, which was along y = 0; else the last one.
core::Vec2 target_aside(const domain::Scan& scan, const RightOfWayParameters& parameters = {}) {
  RightOfWay escape(parameters, setup_of(1));
  drive(escape, 4.0);
  core::Vec2 target = core::Vec2::Zero();
  for (std::uint64_t i = 0; i < 30; ++i) {
    const double x_m = 4.0 - 0.1 * static_cast<double>(i);
    const Scene scene = Scene().tick(50 + i).at(x_m, 0, 180).travelled(8.0 - x_m);
    const Situation situation = scene.situation().with(scan);
    if (i == 0) escape.begin(situation, {});
    escape.watch(situation);
    domain::Guidance guidance;
    EXPECT_EQ(escape.step(situation, guidance), EscapeStatus::kActive);
    if (guidance.has_override) break;
    target = {guidance.target_x_m, guidance.target_y_m};
    if (std::abs(target.y()) > 0.5) break;
  }
  return target;
}

/// It looks back, so that left of it is where y is below 0.
TEST(RightOfWay, GoesAsideWhereThereIsRoom) {
  EXPECT_LT(target_aside(wide_scan(3.0, 3.0, 0.3)).y(), -0.5);
  EXPECT_GT(target_aside(wide_scan(0.3, 3.0, 3.0)).y(), 0.5);
  EXPECT_EQ(target_aside(wide_scan(0.3, 3.0, 0.3)).y(), 0.0);

  domain::Scan scan = wide_scan(3.0, 3.0, 3.0);
  const double first_y_m = target_aside(scan).y();
  ASSERT_GT(std::abs(first_y_m), 0.5);
  (first_y_m < 0.0 ? scan.ranges_m.front() : scan.ranges_m.back()) = 0.5;
  EXPECT_LT(target_aside(scan).y() * first_y_m, -0.25);
}

/// In the open it goes aside at once, after 1 m back: to the left first, where y is below 0.
TEST(RightOfWay, GoesAsideInTheFirstDirectionWithRoomAsFarAsItSays) {
  const domain::Scan open = wide_scan(3.0, 3.0, 3.0);
  RightOfWayParameters parameters;
  EXPECT_NEAR(target_aside(open, parameters).y(), -0.9, 1e-9);

  parameters.reach_m = 0.4;
  EXPECT_NEAR(target_aside(open, parameters).y(), -1.1, 1e-9);
  parameters.aside_rad = core::radians(45.0);
  EXPECT_NEAR(target_aside(open, parameters).y(), -1.1 * std::sqrt(0.5), 1e-9);
}

/// Both sides are blocked at 90 degrees, so the second direction has its turn, then the third.
TEST(RightOfWay, LooksInTheSecondAndThirdDirectionWhereTheFirstHasNoRoom) {
  domain::Scan scan = wide_scan(3.0, 3.0, 3.0);
  RightOfWayParameters parameters;
  parameters.aside_m = 1.5;
  parameters.second_aside_rad = core::radians(30.0);
  parameters.third_aside_rad = core::radians(20.0);
  scan.ranges_m.front() = scan.ranges_m.back() = 0.5;
  EXPECT_NEAR(target_aside(scan, parameters).y(), -1.7 * std::sin(core::radians(30.0)), 1e-9);

  parameters.second_aside_rad = core::radians(85.0);
  EXPECT_NEAR(target_aside(scan, parameters).y(), -1.7 * std::sin(core::radians(20.0)), 1e-9);
}

double trail_points(const RightOfWay& escape) {
  domain::Inside inside;
  escape.tell(Scene().situation(), inside);
  for (const domain::InsideValue& value : inside.values.values()) {
    if (value.name == "trail_points") return std::get<double>(value.value);
  }
  return -1.0;
}

TEST(RightOfWay, NotesAPlaceOfItsWayOnceInASpacing) {
  RightOfWayParameters parameters;
  parameters.trail_spacing_m = 0.45;
  RightOfWay escape(parameters, setup_of(1));
  drive(escape, 2.0);

  EXPECT_EQ(trail_points(escape), 5.0) << "at 0, 0.5, 1, 1.5 and 2 m";
}

/// It creeps back by 0.1 m a tick of 0.5 s, which is no progress for who wants 2 m within 4 s.
TEST(RightOfWay, HoldsWhereItGetsOnTooSlowly) {
  RightOfWayParameters parameters;
  parameters.progress_m = 2.0;
  RightOfWay escape(parameters, setup_of(1));
  drive(escape, 4.0);
  std::uint64_t ticks = 0;
  for (domain::Guidance guidance; !guidance.has_override && ticks < 40; ++ticks) {
    const double x_m = 4.0 - 0.1 * static_cast<double>(ticks);
    const Scene scene = Scene().tick(50 + ticks).at(x_m, 0, 180).travelled(8.0 - x_m);
    const Situation situation = scene.situation().with(wide_scan(0.3, 3.0, 0.3));
    if (ticks == 0) escape.begin(situation, {});
    guidance = {};
    escape.step(situation, guidance);
  }
  EXPECT_EQ(ticks, 9U) << "4 s are 8 ticks after the first";
}

/// Each tick of an escape from begin to end, saved and loaded before it.
TEST(RightOfWay, GoesOnAsBeforeAfterSaveAndLoad) {
  RightOfWay escape({}, setup_of(1));
  drive(escape, 4.0);
  const domain::Scan scan = wide_scan(3.0, 3.0, 0.3);
  core::Pose2 pose{4.0, 0.0, core::radians(180.0)};
  std::vector<std::string> phases;
  EscapeStatus status = EscapeStatus::kActive;
  for (std::uint64_t i = 0; i < 100 && status == EscapeStatus::kActive; ++i) {
    const Scene scene = Scene()
                            .tick(50 + i)
                            .at(pose.x_m, pose.y_m, 180)
                            .travelled(4.0 + 0.1 * static_cast<double>(i));
    const Situation situation = scene.situation().with(scan);
    if (i == 0) escape.begin(situation, {});

    RightOfWay restored({}, setup_of(1));
    const std::string saved = bytes_of(escape);
    core::StateReader reader(saved);
    restored.load(reader);
    ASSERT_TRUE(reader.complete());
    ASSERT_EQ(bytes_of(restored), saved);
    const std::string phase = phase_of(escape, situation);
    if (phases.empty() || phases.back() != phase) phases.push_back(phase);

    escape.watch(situation);
    restored.watch(situation);
    domain::Guidance guidance;
    domain::Guidance again;
    status = escape.step(situation, guidance);
    ASSERT_EQ(restored.step(situation, again), status);
    EXPECT_EQ(again.has_override, guidance.has_override);
    EXPECT_EQ(again.target_is_virtual, guidance.target_is_virtual);
    EXPECT_EQ(again.target_x_m, guidance.target_x_m);
    EXPECT_EQ(again.target_y_m, guidance.target_y_m);
    EXPECT_EQ(again.why, guidance.why);
    ASSERT_EQ(bytes_of(restored), bytes_of(escape));
    if (!guidance.target_is_virtual) continue;
    const core::Vec2 to(guidance.target_x_m - pose.x_m, guidance.target_y_m - pose.y_m);
    pose.x_m += 0.1 * to.x() / core::length(to);
    pose.y_m += 0.1 * to.y() / core::length(to);
  }
  EXPECT_EQ(status, EscapeStatus::kEnded);
  EXPECT_EQ(phases, (std::vector<std::string>{"back", "aside", "hold"}));
}

/// A goal that was taken away cuts the escape off: the way to the next goal is noted again.
TEST(RightOfWay, ItsPhaseEndsWithACancelledGoal) {
  RightOfWay escape({}, setup_of(1));
  drive(escape, 1.0);
  const Scene stuck = Scene().tick(30).at(1, 0, 0);
  escape.begin(stuck.situation(), {});
  domain::Guidance guidance;
  ASSERT_EQ(escape.step(stuck.situation(), guidance), EscapeStatus::kActive);

  // Ticks 31 to 39 had no goal.
  for (int i = 0; i < 20; ++i) {
    const auto tick = static_cast<std::uint64_t>(40 + i);
    escape.watch(Scene().tick(tick).at(1, 0.1 * i, 90).situation());
  }
  const Scene again = Scene().tick(60).at(1, 1.9, 90);
  escape.begin(again.situation(), {});
  ASSERT_EQ(escape.step(again.situation(), guidance), EscapeStatus::kActive);
  EXPECT_GT(guidance.target_y_m, 1.0);  // back along the new way
}

}  // namespace
}  // namespace clew::recover

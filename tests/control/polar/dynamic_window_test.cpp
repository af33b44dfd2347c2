// SPDX-License-Identifier: Apache-2.0
#include "control/polar/dynamic_window.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "control/polar/pose_prediction.hpp"
#include "core/random.hpp"

namespace clew::control {
namespace {

using core::radians;

constexpr double kRadius_m = 0.15;
constexpr double kCycle_s = 0.1;
constexpr double kRounding = 1e-12;

DynamicWindow window(const domain::MotionLimits& drive = {}) {
  return {DynamicWindowParameters{}, drive, kRadius_m};
}

DynamicWindow::Goal ahead(double x_m) { return {{x_m, 0.0}, 0.0}; }

TEST(DynamicWindow, HoldsWhatTheAccelerationsAllowInACycle) {
  DynamicWindow dynamic = window();

  dynamic.choose(0.3, 0.2, kCycle_s, ahead(2.0), {}, {});

  // 0.5 m/s^2 and 90 deg/s^2 over 0.1 s; braking, the last cell, is among it.
  for (const WindowCell& cell : dynamic.cells()) {
    EXPECT_LE(std::fabs(cell.speed_mps - 0.3), 0.05 + kRounding);
    EXPECT_LE(std::fabs(cell.turn_rate_radps - 0.2), radians(9.0) + kRounding);
  }
  EXPECT_NEAR(dynamic.cells().front().speed_mps, 0.25, kRounding);
  EXPECT_NEAR(dynamic.cells()[dynamic.cells().size() - 2].turn_rate_radps, 0.2 + radians(9.0),
              kRounding);
}

TEST(DynamicWindow, KeepsTheLowerOfItsOwnLimitsAndTheDrives) {
  DynamicWindow slow = window({0.2, 0.1, 100.0, 100.0});

  slow.choose(0.2, 0.0, kCycle_s, ahead(2.0), {}, {});

  for (const WindowCell& cell : slow.cells()) {
    EXPECT_LE(cell.speed_mps, 0.2);
    EXPECT_LE(std::fabs(cell.turn_rate_radps), 0.1);
  }
}

TEST(DynamicWindow, SpeedsUpTowardAFarGoal) {
  DynamicWindow dynamic = window();

  const WindowCell& chosen = dynamic.choose(0.3, 0.0, kCycle_s, ahead(2.0), {}, {});

  EXPECT_NEAR(chosen.speed_mps, 0.35, kRounding);
  EXPECT_EQ(chosen.turn_rate_radps, 0.0);
}

TEST(DynamicWindow, ComesToRestAtTheGoal) {
  DynamicWindow dynamic = window();
  core::Pose2 pose;
  double speed_mps = 0.5;
  for (int i = 0; i < 60; ++i) {
    speed_mps = dynamic.choose(speed_mps, 0.0, kCycle_s, ahead(1.0 - pose.x_m), {}, {}).speed_mps;
    pose.x_m += speed_mps * kCycle_s;
  }

  // Within half of the way between two speeds of the window: 0.05 m/s / 6 times 0.1 s and more.
  EXPECT_NEAR(pose.x_m, 1.0, 0.01);
  EXPECT_LT(speed_mps, 0.02);
}

TEST(DynamicWindow, TurnsOnTheSpotTowardAGoalBehind) {
  DynamicWindow dynamic = window();

  const WindowCell& chosen =
      dynamic.choose(0.0, 0.0, kCycle_s, {{-1.0, 0.5}, radians(153.0)}, {}, {});

  EXPECT_EQ(chosen.speed_mps, 0.0);
  EXPECT_NEAR(chosen.turn_rate_radps, radians(9.0), kRounding);
}

TEST(DynamicWindow, KeepsAwayFromReturnsBesideTheWay) {
  DynamicWindowParameters parameters;
  parameters.density_weight_m = 10.0;
  DynamicWindow dynamic(parameters, {}, kRadius_m);

  const WindowCell& chosen = dynamic.choose(0.4, 0.0, kCycle_s, ahead(2.0), {{0.45, 0.3}}, {});

  EXPECT_LT(chosen.turn_rate_radps, 0.0);  // the return is on the left
}

TEST(DynamicWindow, BrakesAlongItsWayWhereNothingElseIsLeft) {
  DynamicWindow dynamic = window();

  // 0.25 m before it, at a speed that needs 0.36 m to rest.
  const WindowCell& chosen = dynamic.choose(0.6, 0.3, kCycle_s, ahead(2.0), {{0.25, 0.0}}, {});

  // 1.2 s to rest; both velocities lose a twelfth of what they are.
  EXPECT_NEAR(chosen.speed_mps, 0.6 * 11.0 / 12.0, kRounding);
  EXPECT_NEAR(chosen.turn_rate_radps, 0.3 * 11.0 / 12.0, kRounding);
  EXPECT_EQ(dynamic.chosen(), dynamic.cells().size() - 1);
  EXPECT_FALSE(chosen.stops_in_time);
}

/// The least distance to a return on the way of a cell, looked at in 200 places.
double clearance_m(const WindowCell& cell, const std::vector<core::Vec2>& returns) {
  const double braking_s =
      std::max(cell.speed_mps / 0.5, std::fabs(cell.turn_rate_radps) / radians(90.0));
  const double lasts_s = kCycle_s + 0.5 * braking_s;
  double least_m = 1e9;
  for (int i = 0; i <= 200; ++i) {
    const core::Pose2 at = along_arc({}, cell.speed_mps * lasts_s * i / 200.0,
                                     cell.turn_rate_radps * lasts_s * i / 200.0);
    for (const core::Vec2& place : returns) least_m = std::min(least_m, distance_m(at, place));
  }
  return least_m;
}

TEST(DynamicWindow, NeverChoosesWhatItCannotStopFromWhereItCould) {
  const core::Random random({5, 0, 0, 0});
  int avoided = 0;
  for (std::uint32_t n = 0; n < 500; ++n) {
    const auto draw = [&](std::uint32_t i) { return random.uniform(20 * n + i); };
    std::vector<core::Vec2> returns;
    for (std::uint32_t i = 0; i < 5; ++i) {
      returns.push_back((0.25 + 0.6 * draw(2 * i)) *
                        core::direction(2.0 * core::kPi * draw(2 * i + 1)));
    }
    DynamicWindow dynamic = window();

    const WindowCell& chosen =
        dynamic.choose(0.6 * draw(10), 1.4 * draw(11) - 0.7, kCycle_s, ahead(2.0), returns, {});

    if (!chosen.stops_in_time) continue;
    // 0.21 m are kept; between two samples the way may come 2 mm nearer (0.06 m apart).
    EXPECT_GT(clearance_m(chosen, returns), kRadius_m + 0.06 - 0.003) << n;
    avoided += std::any_of(dynamic.cells().begin(), dynamic.cells().end(),
                           [](const WindowCell& cell) { return !cell.stops_in_time; });
  }
  EXPECT_GT(avoided, 30);  // in some of them there was something to avoid
}

TEST(DynamicWindow, KeepsAwayFromWhatItRemembersButIsNotStoppedByIt) {
  DynamicWindow dynamic = window();

  const WindowCell& chosen = dynamic.choose(0.4, 0.0, kCycle_s, ahead(2.0), {}, {{0.3, 0.0}});

  const auto& cells = dynamic.cells();
  EXPECT_TRUE(std::all_of(cells.begin(), cells.end(),
                          [](const WindowCell& cell) { return cell.stops_in_time; }));
  const double objective_m = chosen.objective_m;
  EXPECT_LT(dynamic.choose(0.4, 0.0, kCycle_s, ahead(2.0), {}, {}).objective_m, objective_m);
}

TEST(DynamicWindow, MayLeaveWhatItIsTooCloseToButNotGoNearer) {
  const std::vector<core::Vec2> close = {{0.16, 0.0}};
  DynamicWindow dynamic = window();

  const WindowCell& toward = dynamic.choose(0.0, 0.0, kCycle_s, ahead(2.0), close, {});
  EXPECT_EQ(toward.speed_mps, 0.0);

  const WindowCell& away = dynamic.choose(0.0, 0.0, kCycle_s, ahead(2.0), {{-0.16, 0.0}}, {});
  EXPECT_NEAR(away.speed_mps, 0.05, kRounding);
}

}  // namespace
}  // namespace clew::control

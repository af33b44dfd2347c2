// SPDX-License-Identifier: Apache-2.0
#include "drive/dead_reckoning.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace clew::drive {
namespace {

const core::Random kRandom({1, 0, 2, 0});

/// A tick that begins at `from`, turns by turn_rad and then steps.
DeadReckoning::Tick tick_of(const core::Pose2& from, double turn_rad, double step_m) {
  const double heading_rad = from.heading_rad + turn_rad;
  return {from,
          {from.x_m + step_m * core::cos(heading_rad), from.y_m + step_m * core::sin(heading_rad),
           heading_rad},
          step_m,
          turn_rad,
          false,
          0.3};
}

TEST(DeadReckoning, CountsTheTruthWithoutErrors) {
  DeadReckoning reckoning({1, 2, 0.5}, {});

  reckoning.count(tick_of({1, 2, 0.5}, 0.2, 0.1), kRandom);

  EXPECT_NEAR(reckoning.state().pose_odom_robot.x_m, 1 + 0.1 * core::cos(0.7), 1e-12);
  EXPECT_NEAR(reckoning.state().pose_odom_robot.y_m, 2 + 0.1 * core::sin(0.7), 1e-12);
  EXPECT_NEAR(reckoning.state().pose_odom_robot.heading_rad, 0.7, 1e-12);
  EXPECT_NEAR(reckoning.state().travel_m, 0.1, 1e-12);
}

TEST(DeadReckoning, CountsTooManyMetresAndRadiansAsItsErrorsSay) {
  DriftParameters drift;
  drift.m_per_m = 0.1;
  drift.rad_per_rad = 0.5;
  DeadReckoning reckoning({0, 0, 0}, drift);

  reckoning.count(tick_of({0, 0, 0}, 0.0, 0.2), kRandom);
  reckoning.count(tick_of({0.2, 0, 0}, 0.2, 0.0), kRandom);

  EXPECT_NEAR(reckoning.state().pose_odom_robot.x_m, 0.22, 1e-12);
  EXPECT_NEAR(reckoning.state().travel_m, 0.22, 1e-12);
  EXPECT_NEAR(reckoning.state().pose_odom_robot.heading_rad, 0.3, 1e-12);
  EXPECT_NEAR(reckoning.state().turn_rate_radps, 1.0, 1e-12);
}

TEST(DeadReckoning, BelievesACircleWhereAStraightWayVeers) {
  DriftParameters drift;
  drift.rad_per_m = 0.5;
  DeadReckoning reckoning({0, 0, 0}, drift);

  core::Pose2 truth{0, 0, 0};
  for (int i = 0; i < 1000; ++i) {
    const DeadReckoning::Tick tick = tick_of(truth, 0.0, core::kPi / 1000.0);
    reckoning.count(tick, kRandom);
    truth = tick.to;
  }

  // pi metres, on a circle of 2 m: a quarter of it.
  EXPECT_NEAR(reckoning.state().pose_odom_robot.x_m, 2.0, 1e-5);
  EXPECT_NEAR(reckoning.state().pose_odom_robot.y_m, 2.0, 1e-5);
  EXPECT_NEAR(reckoning.state().pose_odom_robot.heading_rad, core::kPi / 2.0, 1e-9);
}

/// Variance of the believed heading and distance after 1 m, cut into so many ticks.
std::pair<double, double> variances(int ticks, const DriftParameters& drift) {
  constexpr int kRuns = 2000;
  double heading_rad2 = 0.0;
  double travel_m2 = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    DeadReckoning reckoning({0, 0, 0}, drift);
    core::Pose2 truth{0, 0, 0};
    for (int i = 0; i < ticks; ++i) {
      const DeadReckoning::Tick tick = tick_of(truth, 0.0, 1.0 / ticks);
      reckoning.count(tick, core::Random({static_cast<std::uint64_t>(run), 0, 2,
                                          static_cast<std::uint64_t>(i)}));
      truth = tick.to;
    }
    const double heading_rad = reckoning.state().pose_odom_robot.heading_rad;
    heading_rad2 += heading_rad * heading_rad / kRuns;
    travel_m2 += (reckoning.state().travel_m - 1.0) * (reckoning.state().travel_m - 1.0) / kRuns;
  }
  return {heading_rad2, travel_m2};
}

TEST(DeadReckoning, DriftsAlikeHoweverTheWayIsCut) {
  DriftParameters drift;
  drift.rad_per_sqrt_m = 0.1;
  drift.m_per_sqrt_m = 0.05;

  for (const int ticks : {4, 20}) {
    const auto [heading_rad2, travel_m2] = variances(ticks, drift);

    // A variance of 2000 numbers has a standard error of sqrt(2 / 2000) of itself; five of them.
    EXPECT_NEAR(heading_rad2, 0.01, 0.01 * 0.16) << ticks;
    EXPECT_NEAR(travel_m2, 0.0025, 0.0025 * 0.16) << ticks;
  }
}

TEST(DeadReckoning, IsAFunctionOfItsRandomNumbers) {
  DriftParameters drift;
  drift.rad_per_sqrt_rad = 0.1;
  const auto heading_rad = [&](std::uint64_t tick) {
    DeadReckoning reckoning({0, 0, 0}, drift);
    reckoning.count(tick_of({0, 0, 0}, 0.5, 0.0), core::Random({1, 0, 2, tick}));
    return reckoning.state().pose_odom_robot.heading_rad;
  };

  EXPECT_EQ(heading_rad(3), heading_rad(3));
  EXPECT_NE(heading_rad(3), heading_rad(4));
}

TEST(DeadReckoning, CountsWaysBackwards) {
  DeadReckoning reckoning({0, 0, 0}, {});

  reckoning.count({{0, 0, 0}, {-0.1, 0, 0}, 0.1, 0.0, true, 0.1}, kRandom);

  EXPECT_NEAR(reckoning.state().pose_odom_robot.x_m, -0.1, 1e-12);
  EXPECT_NEAR(reckoning.state().travel_m, 0.1, 1e-12);
  EXPECT_NEAR(reckoning.state().speed_mps, -1.0, 1e-12);
}

}  // namespace
}  // namespace clew::drive

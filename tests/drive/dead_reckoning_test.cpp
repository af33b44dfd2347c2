// SPDX-License-Identifier: Apache-2.0
#include "drive/dead_reckoning.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/angle.hpp"

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

/// A path of so many metres with bends both ways, in steps of 0.1 m.
DeadReckoning::Tick bend(const core::Pose2& from, int tick) {
  return tick_of(from, tick / 20 % 2 == 0 ? 0.05 : -0.08, 0.1);
}

TEST(DeadReckoning, TellsTheCovarianceThatManyRunsHave) {
  constexpr int kRuns = 2000;
  constexpr int kTicks = 60;
  DriftParameters drift;
  drift.m_per_sqrt_m = 0.02;
  drift.rad_per_sqrt_m = 0.02;
  drift.rad_per_sqrt_rad = 0.02;
  domain::PoseCovariance seen;
  domain::PoseCovariance told;
  for (int run = 0; run < kRuns; ++run) {
    DeadReckoning reckoning({1, 2, 0.5}, drift);
    core::Pose2 truth{1, 2, 0.5};
    for (int i = 0; i < kTicks; ++i) {
      const DeadReckoning::Tick tick = bend(truth, i);
      reckoning.count(tick, core::Random({static_cast<std::uint64_t>(run), 0, 2,
                                          static_cast<std::uint64_t>(i)}));
      truth = tick.to;
    }
    const core::Pose2& belief = reckoning.state().pose_odom_robot;
    const double x_m = belief.x_m - truth.x_m;
    const double y_m = belief.y_m - truth.y_m;
    const double heading_rad = core::wrap_angle_rad(belief.heading_rad - truth.heading_rad);
    seen.x_m2 += x_m * x_m / kRuns;
    seen.xy_m2 += x_m * y_m / kRuns;
    seen.x_heading_m_rad += x_m * heading_rad / kRuns;
    seen.y_m2 += y_m * y_m / kRuns;
    seen.y_heading_m_rad += y_m * heading_rad / kRuns;
    seen.heading_rad2 += heading_rad * heading_rad / kRuns;
    const domain::PoseCovariance c = reckoning.covariance();
    told.x_m2 += c.x_m2 / kRuns;
    told.xy_m2 += c.xy_m2 / kRuns;
    told.x_heading_m_rad += c.x_heading_m_rad / kRuns;
    told.y_m2 += c.y_m2 / kRuns;
    told.y_heading_m_rad += c.y_heading_m_rad / kRuns;
    told.heading_rad2 += c.heading_rad2 / kRuns;
  }

  // A variance of 2000 numbers has a standard error of sqrt(2 / 2000) of itself; five of them. What
  // is told goes by the way that each run believes, so it is the mean of all runs. A covariance has
  // one of at most that of the root of the product of its variances.
  const auto near = [](double a, double b, double scale) { EXPECT_NEAR(a, b, 0.16 * scale); };
  near(told.x_m2, seen.x_m2, seen.x_m2);
  near(told.y_m2, seen.y_m2, seen.y_m2);
  near(told.heading_rad2, seen.heading_rad2, seen.heading_rad2);
  near(told.xy_m2, seen.xy_m2, std::sqrt(seen.x_m2 * seen.y_m2));
  near(told.x_heading_m_rad, seen.x_heading_m_rad, std::sqrt(seen.x_m2 * seen.heading_rad2));
  near(told.y_heading_m_rad, seen.y_heading_m_rad, std::sqrt(seen.y_m2 * seen.heading_rad2));
  EXPECT_GT(std::fabs(seen.y_heading_m_rad), 0.3 * std::sqrt(seen.y_m2 * seen.heading_rad2));
}

TEST(DeadReckoning, TellsASystematicErrorToFirstOrder) {
  DriftParameters drift;
  drift.rad_per_m = 0.003;
  DeadReckoning reckoning({0, 0, 0}, drift);

  core::Pose2 truth{0, 0, 0};
  for (int i = 0; i < 60; ++i) {
    const DeadReckoning::Tick tick = bend(truth, i);
    reckoning.count(tick, kRandom);
    truth = tick.to;
  }

  // One error alone, so the covariance is that error times itself.
  const core::Pose2& belief = reckoning.state().pose_odom_robot;
  const domain::PoseCovariance told = reckoning.covariance();
  EXPECT_NEAR(std::sqrt(told.x_m2), std::fabs(belief.x_m - truth.x_m), 0.002);
  EXPECT_NEAR(std::sqrt(told.y_m2), std::fabs(belief.y_m - truth.y_m), 0.002);
  EXPECT_NEAR(std::sqrt(told.heading_rad2), 6.0 * 0.003, 1e-9);
  EXPECT_GT(std::fabs(belief.y_m - truth.y_m) + std::fabs(belief.x_m - truth.x_m), 0.03);
}

TEST(DeadReckoning, IsCertainWithoutErrors) {
  DeadReckoning reckoning({0, 0, 0}, {});

  reckoning.count(tick_of({0, 0, 0}, 0.2, 0.1), kRandom);

  const domain::PoseCovariance told = reckoning.covariance();
  for (const double value : {told.x_m2, told.xy_m2, told.x_heading_m_rad, told.y_m2,
                             told.y_heading_m_rad, told.heading_rad2}) {
    EXPECT_EQ(value, 0.0);
  }
}

TEST(DeadReckoning, TakesSlipBeforeTheWayWholeAndAlongTheWayHalf) {
  for (const bool on_the_spot : {true, false}) {
    DeadReckoning reckoning({1, 2, 0}, {});
    DeadReckoning::Tick tick = tick_of({1, 2, 0}, 0.0, 0.1);
    tick.turn_rad = 0.4;  // of the wheels; the robot went straight on
    (on_the_spot ? tick.slipped_turn_rad : tick.slipped_bend_rad) = 0.4;

    reckoning.count(tick, kRandom);

    const double bearing_rad = on_the_spot ? 0.4 : 0.2;
    EXPECT_NEAR(reckoning.state().pose_odom_robot.x_m, 1 + 0.1 * std::cos(bearing_rad), 1e-12);
    EXPECT_NEAR(reckoning.state().pose_odom_robot.y_m, 2 + 0.1 * std::sin(bearing_rad), 1e-12);
    EXPECT_NEAR(reckoning.state().pose_odom_robot.heading_rad, 0.4, 1e-12);
  }
}

TEST(DeadReckoning, NeverLeadsToAStateThatIsNone) {
  DriftParameters drift{0.5, 0.5, 0.5, 0.5, 0.5, 0.5};
  DeadReckoning reckoning({0, 0, 0}, drift);
  for (int i = 0; i < 40; ++i) {
    reckoning.count(tick_of({0, 0, 0}, 0.1, 1e4), kRandom);
    ASSERT_TRUE(reckoning.state().is_sound()) << i;
  }
  EXPECT_EQ(reckoning.state().noise.y_m2, 1e9);
}

TEST(DeadReckoning, KnowsAStateThatIsNone) {
  DriftParameters drift;
  drift.rad_per_sqrt_m = 0.1;
  drift.m_per_sqrt_m = 0.1;
  DeadReckoning reckoning({0, 0, 0}, drift);
  for (int i = 0; i < 10; ++i) reckoning.count(tick_of({0, 0, 0}, 0.3, 0.1), kRandom);
  ASSERT_TRUE(reckoning.state().is_sound());

  DeadReckoning::State negative = reckoning.state();
  negative.noise.y_m2 = -1e-6;
  DeadReckoning::State too_much = reckoning.state();
  too_much.noise.xy_m2 = 1.0;
  DeadReckoning::State endless = reckoning.state();
  endless.systematic[1].x_m = 1e300;

  EXPECT_FALSE(negative.is_sound());
  EXPECT_FALSE(too_much.is_sound());
  EXPECT_FALSE(endless.is_sound());
}

}  // namespace
}  // namespace clew::drive

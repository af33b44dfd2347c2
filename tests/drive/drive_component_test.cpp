// SPDX-License-Identifier: Apache-2.0
#include "drive/drive_component.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "drive/turn_then_step.hpp"

namespace clew::drive {
namespace {

using domain::CommandKind;
using domain::Motion;
using domain::Outcome;
using domain::Topic;

/// A drive alone, fed with commands.
class DriveRun {
 public:
  explicit DriveRun(const std::string& obstacles = "", bool safety = true,
                    std::uint64_t max_ticks = 100, const DriftParameters& drift = {},
                    const ArrivalParameters& arrival = {},
                    const std::optional<world::Goals>& goals = std::nullopt,
                    const ActuatorParameters& actuators = {}) {
    auto world = world::World::parse("format: clew-world/1\nname: test\nbounds: [0, 0, 20, 20]\n" +
                                         obstacles +
                                         "\nstart: [5, 5, 0]\ntarget: [6, 5]\ntarget_radius: 0.2\n",
                                     "test.yaml", goals);
    EXPECT_TRUE(world.ok()) << world.error().text();
    runtime::RunSetup setup;
    setup.world = std::make_shared<const world::World>(std::move(world).value());
    setup.max_ticks = max_ticks;
    component_.emplace(std::make_unique<TurnThenStep>(TurnThenStepParameters{}, 0.3),
                       SafetyParameters{safety, 0.005}, drift, actuators, arrival, setup);
    command_.set(index_of(Topic::kCommand));
    for (const Topic topic : {Topic::kState, Topic::kOdometry, Topic::kTarget}) {
      outputs_.set(index_of(topic));
    }
  }

  /// The first tick, without a command.
  const domain::State& start() { return step({}, false); }
  /// The next tick, after `motion`; `present` tells whether the command came.
  const domain::State& step(const Motion& motion, bool present = true) {
    std::get<domain::Command>(messages_).motion = motion;
    runtime::TickOutputs outputs(messages_, outputs_);
    std::get<domain::State>(messages_) = {};
    std::get<domain::Odometry>(messages_) = {};
    component_->step({messages_, command_, present ? command_ : runtime::TopicSet(), tick_++},
                     outputs);
    return std::get<domain::State>(messages_);
  }
  /// Takes over the state of another one.
  void go_on_from(const DriveRun& other) {
    core::StateWriter writer;
    other.component_->save(writer);
    const std::string state = writer.take();
    core::StateReader reader(state);
    component_->load(reader);
    EXPECT_TRUE(reader.complete()) << reader.fault();
    tick_ = other.tick_;
  }
  std::string saved() const {
    core::StateWriter writer;
    component_->save(writer);
    return writer.take();
  }
  /// What is wrong with a state that it is to go on from.
  std::string fault_of(const std::string& state) {
    core::StateReader reader(state);
    component_->load(reader);
    return reader.complete() ? "" : reader.fault();
  }
  const domain::Messages& messages() const { return messages_; }
  /// What is told of the tick before.
  std::string told(bool command_came) const {
    const runtime::TopicSet known = command_came ? outputs_ | command_ : outputs_;
    domain::Inside inside;
    component_->tell({messages_, outputs_ | command_, known, tick_ - 1}, inside);
    return inside.text;
  }

 private:
  std::optional<DriveComponent> component_;
  domain::Messages messages_;
  runtime::TopicSet command_;
  runtime::TopicSet outputs_;
  std::uint64_t tick_ = 0;
};

Motion ahead(double step_m) {
  Motion motion;
  motion.kind = CommandKind::kTurnAndStep;
  motion.step_m = step_m;
  return motion;
}

TEST(DriveComponent, LeadsToTheWaypointsOfTheWorldAndEndsAtTheTarget) {
  DriveRun run("waypoints: [[5.5, 5, 0.1], [5.8, 5]]");
  run.start();
  const auto& target = std::get<domain::Target>(run.messages());
  EXPECT_EQ(target.position(), core::Vec2(5.5, 5.0));
  EXPECT_EQ(target.radius_m, 0.1);

  // A step is 0.15 m at most: 5.3 m is short of the first, 5.45 m is not; 5.57 m is short of the
  // second, whose radius is the world's 0.2 m, and 5.67 m is not.
  run.step(ahead(0.15));
  run.step(ahead(0.15));
  EXPECT_EQ(target.position(), core::Vec2(5.5, 5.0));
  EXPECT_EQ(run.step(ahead(0.15)).outcome, Outcome::kRunning);
  EXPECT_EQ(target.position(), core::Vec2(5.8, 5.0));
  EXPECT_EQ(target.radius_m, 0.2);
  run.step(ahead(0.12));
  EXPECT_EQ(target.position(), core::Vec2(5.8, 5.0));
  EXPECT_EQ(run.step(ahead(0.1)).outcome, Outcome::kRunning);
  EXPECT_EQ(target.position(), core::Vec2(6.0, 5.0));
  EXPECT_EQ(run.step(ahead(0.15)).outcome, Outcome::kReached);
}

TEST(DriveComponent, WaitsWithoutAMission) {
  DriveRun run("", true, 100, {}, {}, world::Goals{});
  run.start();

  const auto& state = run.step(ahead(0.5));

  EXPECT_EQ(state.pose_world_robot.x_m, 5.0);
  EXPECT_EQ(state.outcome, Outcome::kRunning);
  EXPECT_FALSE(state.command_late);
  EXPECT_EQ(std::get<domain::Target>(run.messages()).position(), core::Vec2(5.0, 5.0));
}

TEST(DriveComponent, ArrivesWithinTheWorldsRadiusOrItsOwn) {
  DriveRun by_world;
  DriveRun by_inch("", true, 100, {}, {0.0254});
  by_world.start();
  by_inch.start();

  // The target is 1 m ahead: at 0.75 m, 0.1 m short of it, and 0.02 m short.
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(by_world.step(ahead(0.15)).outcome, Outcome::kRunning);
    by_inch.step(ahead(0.15));
  }
  EXPECT_EQ(by_world.step(ahead(0.15)).outcome, Outcome::kReached);
  EXPECT_EQ(by_inch.step(ahead(0.15)).outcome, Outcome::kRunning);
  EXPECT_EQ(by_inch.step(ahead(0.08)).outcome, Outcome::kReached);
  EXPECT_EQ(std::get<domain::Target>(by_inch.messages()).radius_m, 0.0254);
}

TEST(DriveComponent, StartsWhereTheWorldSays) {
  DriveRun run;

  const domain::State& state = run.start();

  EXPECT_EQ(state.pose_world_robot, (core::Pose2{5, 5, 0}));
  EXPECT_EQ(state.outcome, Outcome::kRunning);
  EXPECT_FALSE(state.command_late);
  const auto& target = std::get<domain::Target>(run.messages());
  EXPECT_EQ(target.position(), core::Vec2(6, 5));
  EXPECT_EQ(target.radius_m, 0.2);
}

TEST(DriveComponent, AppliesTheCommandOfTheTickBefore) {
  DriveRun run;
  run.start();

  const domain::State& state = run.step(ahead(0.1));

  EXPECT_NEAR(state.pose_world_robot.x_m, 5.1, 1e-12);
  const auto& odometry = std::get<domain::Odometry>(run.messages());
  EXPECT_EQ(odometry.pose_odom_robot, state.pose_world_robot);
  EXPECT_NEAR(odometry.travel_m, 0.1, 1e-12);
}

TEST(DriveComponent, BelievesWhatItsWheelsCountAndKnowsTheTruth) {
  DriftParameters drift;
  drift.m_per_m = 0.1;
  DriveRun run("", true, 100, drift);
  run.start();

  const domain::State& state = run.step(ahead(0.1));

  EXPECT_NEAR(state.pose_world_robot.x_m, 5.1, 1e-12);
  const auto& odometry = std::get<domain::Odometry>(run.messages());
  EXPECT_NEAR(odometry.pose_odom_robot.x_m, 5.11, 1e-12);
  EXPECT_NEAR(odometry.travel_m, 0.11, 1e-12);
  EXPECT_NEAR(odometry.speed_mps, 0.11 / 0.3, 1e-12);
  EXPECT_EQ(std::get<domain::Target>(run.messages()).position(), core::Vec2(6, 5));
}

/// A drive whose actuators lag or slip.
DriveRun run_with(const ActuatorParameters& actuators) {
  return DriveRun("", true, 100, {}, {}, std::nullopt, actuators);
}

TEST(DriveComponent, FollowsItsCommandsLateWithLag) {
  ActuatorParameters actuators;
  actuators.lag_s = 0.3;  // a tick: a share of 1 - 1/e at once
  DriveRun run = run_with(actuators);
  run.start();
  const double share = 1.0 - std::exp(-1.0);

  const double first_m = run.step(ahead(0.1)).path_length_m;
  const double second_m = run.step(ahead(0.1)).path_length_m - first_m;
  const double third_m = run.step(ahead(0.0)).path_length_m - first_m - second_m;

  EXPECT_NEAR(first_m, share * 0.1, 1e-12);
  EXPECT_NEAR(second_m, (1.0 - std::exp(-2.0)) * 0.1, 1e-12);
  EXPECT_NEAR(third_m, std::exp(-1.0) * second_m, 1e-12);
  // Wheels that lag do not slip: odometry knows.
  EXPECT_NEAR(std::get<domain::Odometry>(run.messages()).travel_m, first_m + second_m + third_m,
              1e-12);
}

TEST(DriveComponent, StopsAtOnceWithLagWhenItIsToldToStop) {
  ActuatorParameters actuators;
  actuators.lag_s = 1.0;
  DriveRun run = run_with(actuators);
  run.start();
  run.step(ahead(0.1));
  const double before_m = run.step(ahead(0.1)).path_length_m;

  EXPECT_EQ(run.step({}).path_length_m, before_m);
  EXPECT_EQ(run.step(ahead(0.1), false).path_length_m, before_m);
}

TEST(DriveComponent, GoesLessFarThanItsWheelsWhenTheySlip) {
  ActuatorParameters actuators;
  actuators.slip_m_per_m = 0.25;
  actuators.slip_rad_per_rad = 0.5;
  DriveRun run = run_with(actuators);
  run.start();
  Motion motion = ahead(0.1);
  motion.turn_rad = 0.4;

  const domain::State& state = run.step(motion);

  EXPECT_NEAR(state.path_length_m, 0.075, 1e-12);
  EXPECT_NEAR(state.pose_world_robot.heading_rad, 0.2, 1e-12);
  const auto& odometry = std::get<domain::Odometry>(run.messages());
  EXPECT_NEAR(odometry.travel_m, 0.1, 1e-12);
  EXPECT_NEAR(odometry.pose_odom_robot.heading_rad, 0.4, 1e-12);
  // The wheels turned first: they believe that the whole way led there.
  EXPECT_NEAR(odometry.pose_odom_robot.x_m, 5.0 + 0.1 * std::cos(0.4), 1e-12);
  EXPECT_NEAR(odometry.pose_odom_robot.y_m, 5.0 + 0.1 * std::sin(0.4), 1e-12);
}

TEST(DriveComponent, SlipsByChanceAroundWhatItSlipsAlways) {
  ActuatorParameters actuators;
  actuators.slip_m_per_sqrt_m = 0.05;
  actuators.slip_rad_per_sqrt_m = 0.1;
  DriveRun run = run_with(actuators);
  run.start();
  double way_m = 0.0;
  double squares_rad2 = 0.0;
  double heading_rad = 0.0;
  constexpr int kTicks = 90;
  for (int i = 0; i < kTicks; ++i) {
    const domain::State& state = run.step(ahead(0.01));
    way_m = state.path_length_m;
    const double turned_rad = state.pose_world_robot.heading_rad - heading_rad;
    squares_rad2 += turned_rad * turned_rad;
    heading_rad = state.pose_world_robot.heading_rad;
  }

  // Of 0.9 m a standard deviation of 0.047 m, and of a centimetre one of 0.01 rad.
  EXPECT_NEAR(way_m, 0.9, 4 * 0.047);
  EXPECT_NE(way_m, 0.9);
  EXPECT_NEAR(std::sqrt(squares_rad2 / kTicks), 0.01, 0.003);
  EXPECT_NEAR(std::get<domain::Odometry>(run.messages()).travel_m, 0.9, 1e-9);
  EXPECT_NEAR(std::get<domain::Odometry>(run.messages()).pose_odom_robot.heading_rad, 0.0, 1e-9);
}

TEST(DriveComponent, TellsOfLagAndSlipOnlyWhereTheyShow) {
  const std::string said = "Its actuators lag or slip";
  ActuatorParameters lag;
  lag.lag_s = 0.5;
  ActuatorParameters slip;
  slip.slip_m_per_m = 0.2;
  slip.slip_rad_per_sqrt_m = 0.1;
  for (const ActuatorParameters& actuators : {lag, slip}) {
    DriveRun run = run_with(actuators);
    run.start();
    run.step(ahead(0.0));
    EXPECT_EQ(run.told(true).find(said), std::string::npos);
    run.step(ahead(0.1));
    EXPECT_NE(run.told(true).find(said), std::string::npos);
  }
}

TEST(DriveComponent, TellsHowFarSlipMayHaveLedItsOdometryAstray) {
  DriftParameters drift;
  drift.m_per_m = -0.1;
  drift.m_per_sqrt_m = 0.03;
  ActuatorParameters actuators;
  actuators.slip_m_per_m = 0.2;
  actuators.slip_rad_per_rad = 0.5;
  actuators.slip_m_per_sqrt_m = 0.04;
  DriveRun run("", true, 100, drift, {}, std::nullopt, actuators);
  run.start();
  run.step(ahead(0.1));
  const auto& odometry = std::get<domain::Odometry>(run.messages());

  // Straight on, so all is along x: sizes add up, and variances do.
  const double counted_m = odometry.travel_m;
  EXPECT_NEAR(odometry.covariance.x_m2,
              counted_m * counted_m * 0.09 + counted_m * (0.0009 + 0.0016), 1e-12);
  EXPECT_EQ(odometry.covariance.heading_rad2, 0.0);
  Motion turn = ahead(0.0);
  turn.turn_rad = 0.4;
  run.step(turn);
  EXPECT_NEAR(odometry.covariance.heading_rad2, 0.2 * 0.2, 1e-12);
}

TEST(DriveComponent, RefusesAStateOfWheelsThatIsNone) {
  ActuatorParameters actuators;
  actuators.lag_s = 0.5;
  DriveRun run = run_with(actuators);
  run.start();
  run.step(ahead(0.1));
  const std::string saved = run.saved();
  ASSERT_EQ(run.fault_of(saved), "");
  // The wheels' last step stands at its only place.
  const double step_m = 0.1 * (1.0 - std::exp(-0.3 / 0.5));
  std::size_t at = std::string::npos;
  for (std::size_t i = 0; i + sizeof(double) <= saved.size(); ++i) {
    double value = 0.0;
    std::memcpy(&value, saved.data() + i, sizeof(value));
    if (std::fabs(value - step_m) < 1e-12) at = i;
  }
  ASSERT_NE(at, std::string::npos);
  std::string endless = saved;
  const double infinite = std::numeric_limits<double>::infinity();
  std::memcpy(endless.data() + at, &infinite, sizeof(infinite));

  EXPECT_NE(run.fault_of(endless).find("a motion of the wheels is none"), std::string::npos);
  EXPECT_TRUE(std::isfinite(run.step(ahead(0.1)).pose_world_robot.x_m));
}

TEST(DriveComponent, GoesOnAsBeforeAfterSaveAndLoadWithLagAndSlip) {
  ActuatorParameters actuators;
  actuators.lag_s = 0.5;
  actuators.slip_m_per_m = 0.1;
  actuators.slip_rad_per_sqrt_m = 0.1;
  DriveRun run = run_with(actuators);
  run.start();
  run.step(ahead(0.1));
  DriveRun other = run_with(actuators);
  other.start();
  other.step(ahead(0.02));
  other.go_on_from(run);

  EXPECT_EQ(other.step(ahead(0.1)).pose_world_robot, run.step(ahead(0.1)).pose_world_robot);
  EXPECT_EQ(std::get<domain::Odometry>(other.messages()).pose_odom_robot,
            std::get<domain::Odometry>(run.messages()).pose_odom_robot);
}

TEST(DriveComponent, PassesAWaypointWhereTheRobotBelievesToBe) {
  DriftParameters drift;
  drift.m_per_m = 0.5;
  const world::Goals goals = {{{5.3, 5.0}, 0.02}, {{5.0, 6.0}, 0.2}};
  DriveRun run("", true, 100, drift, {}, goals);
  run.start();
  run.step(ahead(0.1));
  EXPECT_EQ(std::get<domain::Target>(run.messages()).position(), core::Vec2(5.3, 5.0));

  run.step(ahead(0.1));

  // In truth it is at 5.2, where no way-point is.
  EXPECT_NEAR(std::get<domain::Odometry>(run.messages()).pose_odom_robot.x_m, 5.3, 1e-12);
  EXPECT_EQ(std::get<domain::Target>(run.messages()).position(), core::Vec2(5.0, 6.0));
}

TEST(DriveComponent, RestsAndSaysSoWhenACommandIsLate) {
  DriveRun run;
  run.start();

  const domain::State& state = run.step(ahead(0.1), false);

  EXPECT_TRUE(state.command_late);
  EXPECT_EQ(state.pose_world_robot.x_m, 5.0);
}

TEST(DriveComponent, TellsWhyTheRobotRests) {
  DriveRun run;
  run.start();
  run.step(ahead(0.1), false);
  EXPECT_NE(run.told(false).find("The command of the tick before was late"), std::string::npos)
      << run.told(false);
  run.step(ahead(0.1));
  EXPECT_NE(run.told(true).find("It was told to"), std::string::npos) << run.told(true);

  DriveRun waiting("", true, 100, {}, {}, world::Goals{});
  waiting.start();
  waiting.step(ahead(0.1));
  EXPECT_NE(waiting.told(true).find("It has no mission, and waits"), std::string::npos)
      << waiting.told(true);
}

TEST(DriveComponent, ReachesTheTargetWithinItsRadiusAtTheEndOfATick) {
  DriveRun run;
  run.start();

  Outcome outcome = Outcome::kRunning;
  int ticks = 0;
  while (outcome == Outcome::kRunning && ticks < 20) {
    outcome = run.step(ahead(0.15)).outcome;
    ++ticks;
  }

  EXPECT_EQ(outcome, Outcome::kReached);
  EXPECT_EQ(ticks, 6);  // 0.8 m of 1 m, in steps of 0.15 m
}

TEST(DriveComponent, EndsWithACollisionWithoutTheSafetyLayer) {
  DriveRun run("walls: [[5.2, 0, 5.2, 20]]", false);
  run.start();

  const domain::State& state = run.step(ahead(0.15));

  EXPECT_EQ(state.outcome, Outcome::kCollided);
  EXPECT_EQ(state.collisions, 1u);
}

TEST(DriveComponent, GoesOnAfterAnInterventionAndTellsTheContacts) {
  DriveRun run("walls: [[5.2, 0, 5.2, 20]]");
  run.start();

  const domain::State& state = run.step(ahead(0.15));

  EXPECT_EQ(state.outcome, Outcome::kRunning);
  EXPECT_EQ(state.safety_stops, 1u);
  const auto& odometry = std::get<domain::Odometry>(run.messages());
  EXPECT_TRUE(odometry.blocked);
  EXPECT_EQ(odometry.contact_bearings_rad.size(), 1u);
}

TEST(DriveComponent, EndsAsUnreachableWhenControlGivesUp) {
  DriveRun run;
  run.start();
  Motion motion;
  motion.kind = CommandKind::kGiveUp;

  EXPECT_EQ(run.step(motion).outcome, Outcome::kUnreachable);
}

TEST(DriveComponent, EndsAtTheLastTick) {
  DriveRun run("", true, 3);
  run.start();

  EXPECT_EQ(run.step({}).outcome, Outcome::kRunning);
  EXPECT_EQ(run.step({}).outcome, Outcome::kRunning);
  EXPECT_EQ(run.step({}).outcome, Outcome::kTimeout);
}

}  // namespace
}  // namespace clew::drive

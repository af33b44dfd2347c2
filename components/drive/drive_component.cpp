// SPDX-License-Identifier: Apache-2.0
#include "drive/drive_component.hpp"

#include <cmath>
#include <utility>

namespace clew::drive {

using domain::Topic;

namespace {

/// Arrival at the target may be a matter of the drive; a way-point has the mission's own radius.
Mission mission_of(const runtime::RunSetup& setup, const ArrivalParameters& arrival) {
  Mission mission{setup.world->waypoints(), setup.max_ticks};
  if (arrival.arrive_m > 0.0 && !mission.waypoints.empty()) {
    mission.waypoints.back().radius_m = arrival.arrive_m;
  }
  return mission;
}

}  // namespace

std::vector<runtime::PortInfo> DriveComponent::ports() {
  return {runtime::delayed_input(Topic::kCommand, "what to do during the tick"),
          runtime::output(Topic::kState, "the truth, for the sensors and the referee"),
          // Recover waits for it, and who reads odometry would interrupt its sending.
          runtime::fallback_output(Topic::kTarget, "where the mission wants the robot"),
          runtime::output(Topic::kOdometry, "where the robot believes it is; contacts")};
}

DriveComponent::DriveComponent(std::unique_ptr<DriveModel> model, const SafetyParameters& safety,
                               const DriftParameters& drift, const ActuatorParameters& actuators,
                               const ArrivalParameters& arrival, const runtime::RunSetup& setup)
    : model_(std::move(model)),
      world_(setup.world),
      seed_(setup.seed),
      robot_index_(setup.robot_index),
      counts_(drift.any() || actuators.slip.any()),
      referee_(mission_of(setup, arrival)),
      body_(world_->start(), setup.behaviour.robot.radius_m, safety),
      actuators_(actuators),
      reckoning_(world_->start(), drift, drift.with(actuators.slip)) {}

void DriveComponent::step(const runtime::TickInputs& inputs, runtime::TickOutputs& outputs) {
  const auto* command = inputs.find<domain::Command>();
  const bool late = inputs.tick() > 0 && command == nullptr;
  // Without a command the robot rests: that is what a late one means. So it does without a mission.
  const bool rests = command == nullptr || referee_.waits();
  const domain::Motion motion = rests ? domain::Motion{} : command->motion;
  if (inputs.tick() > 0) move(motion, inputs.tick() - 1);

  auto& state = outputs.get<domain::State>();
  write_state(state);
  state.command_late = late;
  auto& odometry = outputs.get<domain::Odometry>();
  write_odometry(odometry);
  state.outcome = referee_.judge(inputs.tick(), {state.pose_world_robot, odometry.pose_odom_robot},
                                 state.collisions, motion);
  if (auto* target = outputs.find<domain::Target>()) {
    referee_.announce(odometry.pose_odom_robot, *target);
  }
}

namespace {

/// The emergency stop: whatever the drive's accelerations, and its actuators' lag.
bool brakes(const domain::Motion& motion) {
  return motion.kind == domain::CommandKind::kStop || motion.kind == domain::CommandKind::kGiveUp;
}

}  // namespace

/// Applies the motion during `tick`.
void DriveComponent::move(const domain::Motion& motion, std::uint64_t tick) {
  const Body::State before = body_.state();
  // The safety layer has brought it to rest.
  if (before.blocked) actuators_.come_to_rest();
  before_ = actuators_.any()
                ? actuators_.wheels()
                : Velocities{before.blocked ? 0.0 : before.speed_mps, before.turn_rate_radps};
  const core::Random random({seed_, robot_index_, kRandomComponent, tick});
  Legs legs = model_->legs(motion, before_);
  if (actuators_.any()) legs = actuators_.act(legs, brakes(motion), random);
  body_.move(*world_, legs, static_cast<double>(tick) * model_->tick_s());
  if (!counts_) return;
  const Body::State& after = body_.state();
  const Actuators::Slip& slip = actuators_.slip();
  const double turn_rad = after.turn_rate_radps * model_->tick_s();
  const double wheels_rad = (turn_rad - slip.error_rad) / slip.turn_share;
  const double slipped_turn_rad = actuators_.state().turn_rad * (1.0 - slip.turn_share);
  reckoning_.count({before.pose_world_robot, after.pose_world_robot,
                    (after.path_length_m - before.path_length_m) / slip.way_share, wheels_rad,
                    after.speed_mps < 0.0, model_->tick_s(), slip.way_share, slipped_turn_rad,
                    wheels_rad - turn_rad - slipped_turn_rad},
                   random);
}

void DriveComponent::write_state(domain::State& state) const {
  const Body::State& body = body_.state();
  state.pose_world_robot = body.pose_world_robot;
  state.speed_mps = body.speed_mps;
  state.turn_rate_radps = body.turn_rate_radps;
  state.path_length_m = body.path_length_m;
  state.collisions = body.collisions;
  state.hit_by = body.hit_by;
  state.safety_stops = body.safety_stops;
}

void DriveComponent::write_odometry(domain::Odometry& odometry) const {
  const Body::State& body = body_.state();
  odometry.blocked = body.blocked;
  odometry.contact_bearings_rad = body.contact_bearings_rad;
  if (counts_) {
    const DeadReckoning::State& belief = reckoning_.state();
    odometry.pose_odom_robot = belief.pose_odom_robot;
    odometry.covariance = reckoning_.covariance();
    odometry.speed_mps = belief.speed_mps;
    odometry.turn_rate_radps = belief.turn_rate_radps;
    odometry.travel_m = belief.travel_m;
  } else {
    odometry.pose_odom_robot = body.pose_world_robot;
    odometry.speed_mps = body.speed_mps;
    odometry.turn_rate_radps = body.turn_rate_radps;
    odometry.travel_m = body.path_length_m;
  }
}

void DriveComponent::save(core::StateWriter& writer) const {
  writer(body_.state(), reckoning_.state());
  if (actuators_.any()) writer(actuators_.state());
  referee_.save(writer);
}

namespace {

/// Whether any drive, with any of its parameters, moves so in a tick. A state may come from a
/// stranger's file, and what goes farther than that would take for ever to be swept.
bool is_motion_of_a_tick(double way_m, double turn_rad) {
  constexpr double kMostWay_m = 1e3;
  constexpr double kMostTurn_rad = 3e4;
  return std::fabs(way_m) <= kMostWay_m && std::fabs(turn_rad) <= kMostTurn_rad;
}

bool is_sound(const Body::State& body, double tick_s) {
  return is_motion_of_a_tick(body.speed_mps * tick_s, body.turn_rate_radps * tick_s);
}

bool is_sound(const Actuators::State& wheels, double tick_s) {
  const double speed_ratio = wheels.duration_s > 0.0 ? tick_s / wheels.duration_s : 0.0;
  const auto fits = [&](double ratio) {
    return is_motion_of_a_tick(ratio * wheels.step_m, ratio * wheels.turn_rad) &&
           is_motion_of_a_tick(0.0, ratio * wheels.bend_rad);
  };
  return wheels.duration_s >= 0.0 && std::isfinite(wheels.duration_s) && fits(1.0) &&
         fits(speed_ratio) && std::fabs(wheels.owed_m) <= Actuators::kMostOwed_m;
}

}  // namespace

void DriveComponent::load(core::StateReader& reader) {
  reader(body_.state(), reckoning_.state());
  if (!reader.check(is_sound(body_.state(), model_->tick_s()),
                    "a speed of the robot is one that no drive leads to")) {
    body_.state() = {};
  }
  if (!reader.check(reckoning_.state().is_sound(), "a covariance of the odometry is none")) {
    reckoning_.state() = {};
  }
  if (actuators_.any()) {
    reader(actuators_.state());
    if (!reader.check(is_sound(actuators_.state(), model_->tick_s()),
                      "a motion of the wheels is one that no drive leads to")) {
      actuators_.state() = {};
    }
  }
  referee_.load(reader);
}

}  // namespace clew::drive

// SPDX-License-Identifier: Apache-2.0
#include "robot/robot_drive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "robot/brake.hpp"

namespace clew::robot {
namespace {

/// What odometry says of a robot that stands is rarely zero to the last bit.
constexpr double kStandingSpeed_mps = 0.005;
constexpr double kStandingTurnRate_radps = 0.02;

}  // namespace

RobotDrive::RobotDrive(std::shared_ptr<RobotLink> link, std::unique_ptr<drive::DriveModel> model,
                       const drive::Mission& mission, double radius_m, Handlers handlers)
    : link_(std::move(link)),
      model_(std::move(model)),
      referee_(mission),
      radius_m_(radius_m),
      handlers_(std::move(handlers)) {}

void RobotDrive::step(const runtime::TickInputs& inputs, runtime::TickOutputs& outputs) {
  const auto* command = inputs.find<domain::Command>();
  const domain::Motion motion = command != nullptr ? command->motion : domain::Motion{};
  const Time now = Time::clock::now();
  const RobotView view = link_->look(now);
  tell_covariance_fault(view);

  auto& state = outputs.get<domain::State>();
  state.command_late = inputs.tick() > 0 && command == nullptr;
  state.pose_world_robot = view.odometry.pose_odom_robot;
  state.path_length_m = view.odometry.travel_m;
  const bool stands = std::fabs(view.odometry.speed_mps) < kStandingSpeed_mps &&
                      std::fabs(view.odometry.turn_rate_radps) < kStandingTurnRate_radps;
  state.speed_mps = stands ? 0.0 : view.odometry.speed_mps;
  state.turn_rate_radps = stands ? 0.0 : view.odometry.turn_rate_radps;
  state.outcome =
      referee_.judge(inputs.tick(), {state.pose_world_robot, state.pose_world_robot}, 0, motion);

  const bool is_under_way = state.outcome == domain::Outcome::kRunning && !referee_.waits();
  const bool goes_on = is_heard(view) && is_under_way;
  if (!goes_on) state_.blocked = false;
  state_.told = goes_on ? braked(velocities_for(motion), view) : domain::Velocities{};
  link_->command(state_.told, now);

  state.safety_stops = state_.safety_stops;
  auto& odometry = outputs.get<domain::Odometry>();
  const domain::TickStamp stamp = odometry.stamp;
  odometry = view.odometry;
  odometry.stamp = stamp;
  odometry.blocked = state_.blocked;
  if (state_.blocked) odometry.contact_bearings_rad.push_back(state_.contact_bearing_rad);
  if (auto* target = outputs.find<domain::Target>()) {
    referee_.announce(odometry.pose_odom_robot, *target);
  }
}

/// What the drive of the graph would do in a tick, as one arc.
domain::Velocities RobotDrive::velocities_for(const domain::Motion& motion) const {
  domain::Velocities velocities;
  for (const drive::Leg& leg : model_->legs(motion, state_.told)) {
    velocities.speed_mps += leg.step_m / model_->tick_s();
    velocities.turn_rate_radps += (leg.turn_rad + leg.bend_rad) / model_->tick_s();
  }
  return velocities;
}

domain::Velocities RobotDrive::braked(const domain::Velocities& asked, const RobotView& view) {
  // The next command comes a tick later, and then it still has to brake.
  const double braking_s = 0.5 * std::fabs(asked.speed_mps) / model_->limits().acceleration_mps2;
  const core::Pose2 laser = view.laser_seen_from(view.odometry.pose_odom_robot);
  const auto contact = bearing_of_contact_rad(ros2::returns_of(view.scan, laser),
                                              radius_m_ + link_->settings().brake_margin_m, asked,
                                              2.0 * model_->tick_s() + braking_s);
  if (contact && !state_.blocked) ++state_.safety_stops;
  state_.blocked = contact.has_value();
  state_.contact_bearing_rad = contact.value_or(0.0);
  return contact ? domain::Velocities{0.0, asked.turn_rate_radps} : asked;
}

/// Whether the robot tells what it sees and where it is; if not, says so once.
bool RobotDrive::is_heard(const RobotView& view) {
  const Settings& settings = link_->settings();
  const bool scan_is_older = view.scan_age_s > view.odometry_age_s;
  const double age_s = std::max(view.scan_age_s, view.odometry_age_s);
  const std::string& topic = scan_is_older ? settings.scan_topic : settings.odometry_topic;
  const bool heard = age_s <= settings.timeout_s;
  if (!heard && was_heard_) {
    handlers_.on_notice(
        fmt::format("nothing new on {} for {:.2f} s: the robot is told to stand "
                    "still",
                    topic, age_s));
  } else if (heard && !was_heard_) {
    handlers_.on_notice("the robot is heard again, and goes on");
  }
  was_heard_ = heard;
  if (age_s > settings.give_up_s && !gave_up_) {
    gave_up_ = true;
    handlers_.on_fatal(fmt::format("drive: nothing new on {} for {} s", topic, settings.give_up_s));
  }
  return heard;
}

/// Once: most robots that fill in what is none do so always.
void RobotDrive::tell_covariance_fault(const RobotView& view) {
  if (view.covariance_fault.empty() || std::exchange(told_covariance_fault_, true)) return;
  handlers_.on_notice(fmt::format("{}: {}: the pose counts as exact wherever that is so",
                                  link_->settings().odometry_topic, view.covariance_fault));
}

void RobotDrive::save(core::StateWriter& writer) const {
  writer(state_.told.speed_mps, state_.told.turn_rate_radps, state_.blocked,
         state_.contact_bearing_rad, state_.safety_stops);
  referee_.save(writer);
}

void RobotDrive::load(core::StateReader& reader) {
  reader(state_.told.speed_mps, state_.told.turn_rate_radps, state_.blocked,
         state_.contact_bearing_rad, state_.safety_stops);
  referee_.load(reader);
}

}  // namespace clew::robot

// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "domain/words.hpp"
#include "drive/drive_component.hpp"

namespace clew::drive {
namespace {

void tell_legs(const Legs& legs, domain::InsideGroup& group) {
  for (const Leg& leg : legs) {
    domain::InsideGroup& item = group.item("legs");
    item.number("turn", leg.turn_rad, "rad");
    item.number("step", leg.step_m, "m");
    item.number("bend", leg.bend_rad, "rad");
    item.number("duration", leg.duration_s, "s");
  }
}

void tell_limits(const domain::MotionLimits& limits, domain::InsideGroup& group) {
  group.bound("speed", limits.speed_mps, "mps");
  group.bound("turn_rate", limits.turn_rate_radps, "radps");
  group.bound("acceleration", limits.acceleration_mps2, "mps2");
  group.bound("turn_acceleration", limits.turn_acceleration_radps2, "radps2");
}

}  // namespace

void DriveComponent::tell(const runtime::TickInputs& samples, domain::Inside& inside) const {
  const auto* command = samples.find<domain::Command>();
  if (samples.tick() == 0) {
    inside.say("The robot stands at its start.");
  } else if (referee_.waits()) {
    inside.say("It has no mission, and waits where it is.");
    tell_motion({}, inside);
  } else if (command == nullptr) {
    inside.say("The command of the tick before was late, so the robot came to rest.");
    tell_motion({}, inside);
  } else {
    inside.say("It was told to " + domain::say_motion(command->motion) + ".");
    tell_motion(command->motion, inside);
  }
  const auto& state = samples.get<domain::State>();
  const core::Vec2 position = state.pose_world_robot.position();
  inside.say("It stands at " + domain::say_place(position) + ", after " +
             domain::say_metres(state.path_length_m) + " of path.");
  tell_mission(position, inside);
  tell_limits(model_->limits(), inside.values.group("limits"));
  inside.values.number("collisions", state.collisions);
  inside.values.number("hit_by", state.hit_by);
  inside.values.number("safety_stops", state.safety_stops);
  tell_belief(inside);
}

void DriveComponent::tell_mission(const core::Vec2& position, domain::Inside& inside) const {
  const world::Route& route = referee_.route();
  inside.values.number("waypoints", static_cast<double>(route.size()));
  inside.values.number("waypoints_passed", static_cast<double>(route.passed()));
  if (route.empty()) return;
  const double distance_m = core::length(route.next().place - position);
  const bool is_last = route.passed() + 1 == route.size();
  inside.say("The mission's " +
             (is_last ? std::string("target")
                      : "way-point " + std::to_string(route.passed() + 1) + " of " +
                            std::to_string(route.size())) +
             " is " + domain::say_metres(distance_m) + " away.");
  inside.values.number("distance_to_target", distance_m, "m");
  inside.values.number("arrival_within", route.next().radius_m, "m");
}

/// What the drive made of a command, and what the world made of that.
void DriveComponent::tell_motion(const domain::Motion& motion, domain::Inside& inside) const {
  domain::InsideGroup& group = inside.values.group("motion");
  group.text("told", domain::say_motion(motion));
  group.number("speed_before", before_.speed_mps, "mps");
  group.number("turn_rate_before", before_.turn_rate_radps, "radps");
  tell_legs(model_->legs(motion, before_), group);
  const Body::State& body = body_.state();
  group.number("speed", body.speed_mps, "mps");
  group.number("turn_rate", body.turn_rate_radps, "radps");
  group.flag("blocked", body.blocked);
  group.flag("struck", body.struck);
  if (actuators_.any()) {
    const Velocities wheels = actuators_.wheels();
    group.number("wheels_speed", wheels.speed_mps, "mps");
    group.number("wheels_turn_rate", wheels.turn_rate_radps, "radps");
    group.number("way_share", actuators_.slip().way_share);
    Actuators::State asked;
    for (const Leg& leg : model_->legs(motion, before_)) asked.add(leg);
    if (actuators_.differs(asked)) {
      inside.say("Its actuators lag or slip: it moved otherwise than its drive had it.");
    }
  }
  if (body.blocked) inside.say("Something was in the way and cut the motion short.");
  if (body.struck) inside.say("A moving obstacle ran into it.");
}

void DriveComponent::tell_belief(domain::Inside& inside) const {
  if (!counts_) return;
  const core::Pose2& truth = body_.state().pose_world_robot;
  const core::Pose2& belief = reckoning_.state().pose_odom_robot;
  const double off_m = core::length(belief.position() - truth.position());
  const double turned_rad = core::wrap_angle_rad(belief.heading_rad - truth.heading_rad);
  inside.values.number("odometry_error", off_m, "m");
  inside.values.number("odometry_heading_error", turned_rad, "rad");
  inside.say("Its odometry is " + domain::say_metres(off_m) + " and " +
             domain::say_degrees(turned_rad) + " off.");
}

}  // namespace clew::drive

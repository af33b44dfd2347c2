// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "control/control_component.hpp"
#include "domain/words.hpp"
#include "scan/nearest_return.hpp"

namespace clew::control {
namespace {

bool same_motion(const domain::Motion& a, const domain::Motion& b) {
  return a.kind == b.kind && a.turn_rad == b.turn_rad && a.step_m == b.step_m &&
         a.speed_mps == b.speed_mps && a.turn_rate_radps == b.turn_rate_radps &&
         a.left_mps == b.left_mps && a.right_mps == b.right_mps;
}

}  // namespace

void ControlComponent::tell(const runtime::TickInputs& samples, domain::Inside& inside) const {
  const auto& odometry = samples.get<domain::Odometry>();
  const auto* guidance = samples.find<domain::Guidance>();
  const auto& motion = samples.get<domain::Command>().motion;
  if (motion.kind == domain::CommandKind::kGiveUp) {
    inside.say("Recovery holds the target unreachable, so the robot gives up.");
    inside.values.text("decided", "give_up");
    return;
  }
  const core::Vec2 target_odom = guidance != nullptr
                                     ? core::Vec2(guidance->target_x_m, guidance->target_y_m)
                                     : samples.get<domain::Target>().position();
  const bool is_virtual = guidance != nullptr && guidance->target_is_virtual;
  const double distance_m = core::distance_m(odometry.pose_odom_robot, target_odom);
  const double bearing_rad = core::bearing_rad(odometry.pose_odom_robot, target_odom);
  inside.say("The " + std::string(is_virtual ? "virtual target" : "target") + " is " +
             domain::say_metres(distance_m) + " away, " + domain::say_bearing(bearing_rad) + ".");
  domain::InsideGroup& target = inside.values.group("target");
  target.flag("virtual", is_virtual);
  target.number("distance", distance_m, "m");
  target.number("bearing", bearing_rad, "rad");
  inside.picture.layers.push_back(
      {"active target", domain::PictureLayer::Kind::kGoal, {}, {target_odom}});
  tell_sight(odometry, samples.get<domain::Scan>(), inside);
  tell_decision(odometry, target_odom, inside);
  tell_reactions(samples, inside);
  tell_guard(motion, inside);
}

/// What it saw, virtual obstacles included.
void ControlComponent::tell_sight(const domain::Odometry& odometry, const domain::Scan& scan,
                                  domain::Inside& inside) const {
  const scan::Return nearest = scan::nearest_return(seen_);
  std::size_t shortened = 0;
  domain::PictureLayer returns{"returns of this scan", domain::PictureLayer::Kind::kPoints, {}, {}};
  const core::Pose2& pose = odometry.pose_odom_robot;
  for (std::size_t i = 0; i < seen_.ranges_m.size(); ++i) {
    if (seen_.ranges_m[i] < scan.ranges_m[i]) ++shortened;
    if (seen_.ranges_m[i] >= seen_.range_max_m) continue;
    returns.places_odom.push_back(pose.position() +
                                  (radius_m_ + seen_.ranges_m[i]) *
                                      core::direction(pose.heading_rad + seen_.bearing_rad(i)));
  }
  inside.values.list("readings", seen_.ranges_m, "m");
  inside.values.number("nearest", nearest.range_m, "m");
  inside.values.number("nearest_bearing", core::wrap_angle_rad(nearest.bearing_rad), "rad");
  inside.values.number("shortened_by_virtual_obstacles", static_cast<double>(shortened));
  inside.picture.layers.push_back(std::move(returns));
  if (nearest.range_m < seen_.range_max_m) {
    inside.say("The nearest obstacle is " + domain::say_metres(nearest.range_m) + " away, " +
               domain::say_bearing(nearest.bearing_rad) + ".");
  } else {
    inside.say("No obstacle is in range.");
  }
  if (shortened > 0) {
    inside.say("Virtual obstacles shortened " + domain::say_count(shortened, "reading") + ".");
  }
}

void ControlComponent::tell_decision(const domain::Odometry& odometry,
                                     const core::Vec2& target_odom, domain::Inside& inside) const {
  switch (decider_) {
    case Decider::kNobody:
      inside.values.text("decided", "nobody");
      break;
    case Decider::kRecovery:
      inside.values.text("decided", "recovery");
      inside.say("Recovery overrides the controller and asks to " + domain::say_motion(wanted_) +
                 ".");
      break;
    case Decider::kHeading:
      inside.values.text("decided", "heading");
      inside.say(
          "It is at the target, and turns on the spot to the heading that the mission wants.");
      break;
    case Decider::kApproach:
      inside.values.text("decided", "final_approach");
      inside.say("Nothing is in the way to the target, so the final approach steers and asks to " +
                 domain::say_motion(wanted_) + ".");
      break;
    case Decider::kController: {
      inside.values.text("decided", "controller");
      domain::Inside part;
      controller_->tell(odometry, seen_, target_odom, part);
      inside.add("controller", std::move(part));
      inside.say("So the controller asks to " + domain::say_motion(wanted_) + ".");
      break;
    }
  }
  inside.values.text("asked_for", domain::say_motion(wanted_));
}

void ControlComponent::tell_reactions(const runtime::TickInputs& samples,
                                      domain::Inside& inside) const {
  for (std::size_t i = 0; i < reactions_.size() && i <= reacted_.value_or(i); ++i) {
    domain::Inside part;
    reactions_[i].reaction->tell(samples.get<domain::Odometry>(), seen_,
                                 samples.get<domain::Landmark>(), wanted_, part);
    const bool acted = reacted_ == i;
    inside.say(part.text);
    if (acted) {
      inside.say("So " + reactions_[i].name + " asks to " + domain::say_motion(asked_) + ".");
    }
    for (auto& layer : part.picture.layers) inside.picture.layers.push_back(std::move(layer));
    domain::InsideGroup& item = inside.values.item("reaction");
    item.text("name", reactions_[i].name);
    item.flag("acted", acted);
    for (const domain::InsideValue& value : part.values.values()) item.put(value);
  }
}

void ControlComponent::tell_guard(const domain::Motion& motion, domain::Inside& inside) const {
  const bool kept = same_motion(motion, asked_);
  domain::InsideGroup& guard = inside.values.group("step_guard");
  guard.flag("changed_the_motion", !kept);
  guard.number("turning_side", guard_.state().turning_side);
  guard.number("contacts", static_cast<double>(guard_.state().contacts_odom_rad.size()));
  guard.text("motion", domain::say_motion(motion));
  inside.say(kept ? "The step guard lets that pass."
                  : "The step guard allows less: " + domain::say_motion(motion) + ".");
}

}  // namespace clew::control

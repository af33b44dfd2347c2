// SPDX-License-Identifier: Apache-2.0
#include "control/control_component.hpp"

#include <utility>

#include "control/scan_overlay.hpp"

namespace clew::control {

using domain::Topic;

std::vector<runtime::PortInfo> ControlComponent::ports() {
  return {
      runtime::required_input(Topic::kOdometry, "where the robot believes it is; contacts"),
      runtime::required_input(Topic::kScan, "what is around"),
      runtime::optional_input(Topic::kGuidance, "the active target, and what recovery asks for"),
      runtime::fallback_input(Topic::kTarget, Topic::kGuidance, "the mission's target"),
      runtime::output(Topic::kCommand, "the motion for this tick")};
}

ControlComponent::ControlComponent(std::unique_ptr<Controller> controller,
                                   const ControlParameters& parameters,
                                   const runtime::RunSetup& setup)
    : controller_(std::move(controller)),
      approach_(parameters.approach, setup.behaviour),
      guard_(parameters.guard, setup.behaviour),
      radius_m_(setup.behaviour.robot.radius_m) {}

void ControlComponent::step(const runtime::TickInputs& inputs, runtime::TickOutputs& outputs) {
  const auto& odometry = inputs.get<domain::Odometry>();
  const auto* guidance = inputs.find<domain::Guidance>();
  decider_ = Decider::kNobody;
  domain::Motion& motion = outputs.get<domain::Command>().motion;
  if (guidance != nullptr && guidance->mode == domain::GuidanceMode::kUnreachable) {
    motion.kind = domain::CommandKind::kGiveUp;
    return;
  }

  seen_ = inputs.get<domain::Scan>();
  if (guidance != nullptr) {
    overlay_virtual_obstacles(*guidance, odometry.pose_odom_robot, radius_m_, seen_);
  }
  if (guidance != nullptr && guidance->has_override) {
    decider_ = Decider::kRecovery;
    wanted_ = guidance->override_motion;
    motion = guard_.limit(wanted_, odometry, seen_);
    return;
  }
  const core::Vec2 target_odom = guidance != nullptr
                                     ? core::Vec2(guidance->target_x_m, guidance->target_y_m)
                                     : inputs.get<domain::Target>().position();
  motion = steer(odometry, guidance, target_odom);
}

/// The final approach where it can, else the controller.
domain::Motion ControlComponent::steer(const domain::Odometry& odometry,
                                       const domain::Guidance* guidance,
                                       const core::Vec2& target_odom) {
  if (guidance == nullptr || !guidance->target_is_virtual) {
    if (const auto straight = approach_.step(odometry, seen_, target_odom)) {
      const auto cut = guard_.cut_step(*straight, odometry, seen_, approach_.needs());
      decider_ = Decider::kApproach;
      wanted_ = *straight;
      if (cut) return *cut;
      approach_.hold(odometry);
    }
  }
  decider_ = Decider::kController;
  wanted_ = controller_->step(odometry, seen_, target_odom);
  return guard_.limit(wanted_, odometry, seen_);
}

void ControlComponent::save(core::StateWriter& writer) const {
  writer(guard_.state(), approach_.state());
  controller_->save(writer);
}

void ControlComponent::load(core::StateReader& reader) {
  reader(guard_.state(), approach_.state());
  const auto side = guard_.state().turning_side;
  if (!reader.check(-1 <= side && side <= 1, "there is no such side")) guard_.state() = {};
  controller_->load(reader);
}

}  // namespace clew::control

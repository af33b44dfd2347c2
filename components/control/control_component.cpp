// SPDX-License-Identifier: Apache-2.0
#include "control/control_component.hpp"

#include <utility>

#include "control/scan_overlay.hpp"
#include "runtime/on_demand.hpp"

namespace clew::control {

using domain::Topic;

std::vector<runtime::PortInfo> ControlComponent::ports() {
  return {
      runtime::required_input(Topic::kOdometry, "where the robot believes it is; contacts"),
      runtime::required_input(Topic::kScan, "what is around"),
      runtime::optional_input(Topic::kGuidance, "the active target, and what recovery asks for"),
      runtime::fallback_input(Topic::kTarget, Topic::kGuidance, "the mission's target"),
      runtime::on_demand_input(Topic::kLandmark, "what moves around the robot"),
      runtime::output(Topic::kCommand, "the motion for this tick")};
}

ControlComponent::ControlComponent(std::unique_ptr<Controller> controller,
                                   const ControlParameters& parameters,
                                   const runtime::RunSetup& setup,
                                   std::vector<NamedReaction> reactions)
    : controller_(std::move(controller)),
      heading_(setup.behaviour),
      approach_(parameters.approach, setup.behaviour),
      guard_(parameters.guard, setup.behaviour),
      reactions_(std::move(reactions)),
      radius_m_(setup.behaviour.robot.radius_m) {}

void ControlComponent::step(const runtime::TickInputs& inputs, runtime::TickOutputs& outputs) {
  const auto& odometry = inputs.get<domain::Odometry>();
  const auto* guidance = inputs.find<domain::Guidance>();
  decider_ = Decider::kNobody;
  auto& command = outputs.get<domain::Command>();
  domain::Motion& motion = command.motion;
  if (guidance != nullptr && guidance->mode == domain::GuidanceMode::kUnreachable) {
    motion.kind = domain::CommandKind::kGiveUp;
    return;
  }

  seen_ = inputs.get<domain::Scan>();
  if (guidance != nullptr) {
    overlay_virtual_obstacles(*guidance, odometry.pose_odom_robot, radius_m_, seen_);
  }
  motion = steer(inputs, guidance, outputs);
  if (decider_ == Decider::kController) controller_->tell_virtual_targets(command.virtual_targets);
}

/// What recovery, the final approach or the controller wants, after reactions and guard.
domain::Motion ControlComponent::steer(const runtime::TickInputs& inputs,
                                       const domain::Guidance* guidance,
                                       const runtime::TickOutputs& outputs) {
  const auto& odometry = inputs.get<domain::Odometry>();
  reacted_.reset();
  auto steers = StepGuard::Steers::kAnybody;
  if (guidance != nullptr && guidance->has_override) {
    decider_ = Decider::kRecovery;
    if (guidance->target_is_virtual) steers = StepGuard::Steers::kLed;
    wanted_ = guidance->override_motion;
  } else {
    const ActiveTarget target = guidance != nullptr
                                    ? ActiveTarget::of(*guidance)
                                    : ActiveTarget::of(inputs.get<domain::Target>());
    if (const auto turn = heading_.step(odometry.pose_odom_robot, target)) {
      decider_ = Decider::kHeading;
      wanted_ = *turn;
    } else {
      if (const auto motion = approach(inputs, target)) return *motion;
      decider_ = Decider::kController;
      const auto part = outputs.part("controller");
      wanted_ = controller_->step(odometry, seen_, target.position_odom);
    }
  }
  asked_ = react(inputs).value_or(wanted_);
  if (reacted_) steers = StepGuard::Steers::kAnybody;
  const auto part = outputs.part("guard");
  return guard_.limit(asked_, odometry, seen_, steers);
}

/// The motion of the final approach; nothing where the controller must steer.
std::optional<domain::Motion> ControlComponent::approach(const runtime::TickInputs& inputs,
                                                         const ActiveTarget& target) {
  if (target.is_virtual) return std::nullopt;
  const auto& odometry = inputs.get<domain::Odometry>();
  const auto straight = approach_.step(odometry, seen_, target.position_odom);
  if (!straight) return std::nullopt;
  decider_ = Decider::kApproach;
  wanted_ = *straight;
  asked_ = react(inputs).value_or(wanted_);
  if (reacted_) return guard_.limit(asked_, odometry, seen_);
  const auto cut = guard_.cut_step(wanted_, odometry, seen_, approach_.needs());
  if (!cut) approach_.hold(odometry);
  return cut;
}

/// The motion of the first reaction that does not let the wanted one pass.
std::optional<domain::Motion> ControlComponent::react(const runtime::TickInputs& inputs) {
  for (std::size_t i = 0; i < reactions_.size(); ++i) {
    auto other = reactions_[i].reaction->react(inputs.get<domain::Odometry>(), seen_,
                                               inputs.get<domain::Landmark>(), wanted_);
    if (!other) continue;
    reacted_ = i;
    return other;
  }
  return std::nullopt;
}

void ControlComponent::save(core::StateWriter& writer) const {
  writer(guard_.state(), heading_.state(), approach_.state());
  controller_->save(writer);
  for (const NamedReaction& one : reactions_) one.reaction->save(writer);
}

void ControlComponent::load(core::StateReader& reader) {
  reader(guard_.state(), heading_.state(), approach_.state());
  const auto side = guard_.state().turning_side;
  if (!reader.check(-1 <= side && side <= 1, "there is no such side")) guard_.state() = {};
  controller_->load(reader);
  for (const NamedReaction& one : reactions_) one.reaction->load(reader);
}

}  // namespace clew::control

// SPDX-License-Identifier: Apache-2.0
#include "drive/stage.hpp"

#include <utility>

#include "drive/drive_component.hpp"
#include "drive/registry.hpp"

namespace clew::drive {
namespace {

// What a model can do depends on its parameters alone, not on the robot that it drives.
double tick_s(const runtime::StageConfig& config) {
  return drive_models().make(config.part("behaviour"), {}).value()->tick_s();
}
domain::MotionLimits limits(const runtime::StageConfig& config) {
  return drive_models().make(config.part("behaviour"), {}).value()->limits();
}

/// The parameters of the stage itself: those of the safety layer, of odometry, of the actuators
/// and of arrival.
std::vector<core::ParameterInfo> parameters() {
  auto infos = core::describe_parameters<SafetyParameters>();
  const auto drift = core::describe_parameters<DriftParameters>();
  infos.insert(infos.end(), drift.begin(), drift.end());
  const auto actuators = core::describe_parameters<ActuatorParameters>();
  infos.insert(infos.end(), actuators.begin(), actuators.end());
  const auto arrival = core::describe_parameters<ArrivalParameters>();
  infos.insert(infos.end(), arrival.begin(), arrival.end());
  return infos;
}

core::Result<std::unique_ptr<runtime::Component>> make(const runtime::StageConfig& config,
                                                       const runtime::RunSetup& setup) {
  auto model = drive_models().make(config.part("behaviour"), setup.behaviour);
  if (!model.ok()) return model.error();
  return std::unique_ptr<runtime::Component>(std::make_unique<DriveComponent>(
      std::move(model).value(), core::read_parameters<SafetyParameters>(config.parameters),
      core::read_parameters<DriftParameters>(config.parameters),
      core::read_parameters<ActuatorParameters>(config.parameters),
      core::read_parameters<ArrivalParameters>(config.parameters), setup));
}

}  // namespace

const runtime::StageInfo& stage() {
  static const runtime::StageInfo info = {
      "drive",
      "the simulated robot: kinematics, contact, and how the run ends",
      DriveComponent::ports(),
      parameters(),
      {{"behaviour", false, drive_models().variants()}},
      tick_s,
      nullptr,
      make,
      limits,
      /*knows_world=*/true};
  return info;
}

}  // namespace clew::drive

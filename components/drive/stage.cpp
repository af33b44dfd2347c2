// SPDX-License-Identifier: Apache-2.0
#include "drive/stage.hpp"

#include <utility>

#include "drive/drive_component.hpp"
#include "drive/registry.hpp"

namespace clew::drive {
namespace {

double tick_s(const runtime::StageConfig& config) {
  // The duration depends on the model alone, not on the robot that it drives.
  return drive_models().make(config.part("behaviour"), {}).value()->tick_s();
}

core::Result<std::unique_ptr<runtime::Component>> make(const runtime::StageConfig& config,
                                                       const runtime::RunSetup& setup) {
  auto model = drive_models().make(config.part("behaviour"), setup.behaviour);
  if (!model.ok()) return model.error();
  return std::unique_ptr<runtime::Component>(std::make_unique<DriveComponent>(
      std::move(model).value(), core::read_parameters<SafetyParameters>(config.parameters), setup));
}

}  // namespace

const runtime::StageInfo& stage() {
  static const runtime::StageInfo info = {
      "drive",
      "the simulated robot: kinematics, contact, and how the run ends",
      DriveComponent::ports(),
      core::describe_parameters<SafetyParameters>(),
      {{"behaviour", false, drive_models().variants()}},
      tick_s,
      nullptr,
      make};
  return info;
}

}  // namespace clew::drive

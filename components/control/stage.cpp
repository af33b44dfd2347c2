// SPDX-License-Identifier: Apache-2.0
#include "control/stage.hpp"

#include <utility>

#include "control/control_component.hpp"
#include "control/registry.hpp"

namespace clew::control {
namespace {

core::Result<std::unique_ptr<runtime::Component>> make(const runtime::StageConfig& config,
                                                       const runtime::RunSetup& setup) {
  auto controller = controllers().make(config.part("behaviour"), setup.behaviour);
  if (!controller.ok()) return controller.error();
  std::vector<ControlComponent::NamedReaction> made;
  for (const runtime::PartChoice& choice : config.parts.at("reaction")) {
    auto reaction = reactions().make(choice, setup.behaviour);
    if (!reaction.ok()) return reaction.error();
    made.push_back({choice.name, std::move(reaction).value()});
  }
  return std::unique_ptr<runtime::Component>(std::make_unique<ControlComponent>(
      std::move(controller).value(), core::read_parameters<ControlParameters>(config.parameters),
      setup, std::move(made)));
}

}  // namespace

const runtime::StageInfo& stage() {
  static const runtime::StageInfo info = {
      "control",
      "chooses the motion toward the active target",
      ControlComponent::ports(),
      core::describe_parameters<ControlParameters>(),
      {{"behaviour", false, controllers().variants()}, {"reaction", true, reactions().variants()}},
      [](const runtime::StageConfig&) { return 0.0; },
      nullptr,
      make};
  return info;
}

}  // namespace clew::control

// SPDX-License-Identifier: Apache-2.0
#include "recover/stage.hpp"

#include <algorithm>
#include <utility>

#include "recover/recover_component.hpp"
#include "recover/registry.hpp"

namespace clew::recover {
namespace {

using core::Result;

/// Makes the behaviours of a part, in order.
template <typename Behaviour>
Result<std::vector<Named<Behaviour>>> make_all(const runtime::Registry<Behaviour>& registry,
                                               const std::vector<runtime::PartChoice>& choices,
                                               const runtime::RunSetup& setup) {
  std::vector<Named<Behaviour>> all;
  for (const runtime::PartChoice& choice : choices) {
    auto made = registry.make(choice, setup.behaviour);
    if (!made.ok()) return made.error();
    all.push_back({choice.name, std::move(made).value()});
  }
  return all;
}

/// Makes a local map if anybody reads it.
void add_local_map(const map::LocalMapParameters& parameters, double radius_m,
                   RecoverComponent::Parts& parts) {
  const auto reads = [](const auto& named) { return named.behaviour->reads_local_map(); };
  const auto& shadows = parts.shadows;
  const auto& escapes = parts.escapes;
  const bool from_start = reads(parts.detector) || (!escapes.empty() && reads(escapes.front())) ||
                          std::any_of(shadows.begin(), shadows.end(), reads);
  if (!from_start && std::none_of(escapes.begin(), escapes.end(), reads)) return;
  parts.local_map.emplace(parameters, radius_m);
  parts.maps_late = !from_start;
}

Result<std::unique_ptr<runtime::Component>> make(const runtime::StageConfig& config,
                                                 const runtime::RunSetup& setup) {
  RecoverComponent::Parts parts;
  auto detector = detectors().make(config.part("detector"), setup.behaviour);
  if (!detector.ok()) return detector.error();
  parts.detector = {config.part("detector").name, std::move(detector).value()};
  auto shadows = make_all(detectors(), config.parts.at("shadow"), setup);
  if (!shadows.ok()) return shadows.error();
  parts.shadows = std::move(shadows).value();
  auto made_escapes = make_all(escapes(), config.parts.at("escape"), setup);
  if (!made_escapes.ok()) return made_escapes.error();
  parts.escapes = std::move(made_escapes).value();

  const auto parameters = core::read_parameters<RecoverParameters>(config.parameters);
  add_local_map(parameters.local_map, setup.behaviour.robot.radius_m, parts);
  if (parameters.immediate_memory) {
    const auto resource = setup.behaviour.resources.find("rulebases", parameters.actions);
    if (!resource.ok()) return resource.error();
    auto memory = ImmediateMemory::parse(*resource);
    if (!memory.ok()) return memory.error();
    parts.immediate_memory = std::move(memory).value();
  }
  return std::unique_ptr<runtime::Component>(std::make_unique<RecoverComponent>(std::move(parts)));
}

}  // namespace

const runtime::StageInfo& stage() {
  static const runtime::StageInfo info = {"recover",
                                          "recognises traps and leads out of them",
                                          RecoverComponent::ports(),
                                          core::describe_parameters<RecoverParameters>(),
                                          {{"detector", false, detectors().variants()},
                                           {"escape", true, escapes().variants()},
                                           {"shadow", true, detectors().variants()}},
                                          [](const runtime::StageConfig&) { return 0.0; },
                                          nullptr,
                                          make};
  return info;
}

}  // namespace clew::recover

// SPDX-License-Identifier: Apache-2.0
#include "stages/all.hpp"

#include <string>
#include <utility>

#include "classify/registry.hpp"
#include "classify/stage.hpp"
#include "control/registry.hpp"
#include "control/stage.hpp"
#include "drive/registry.hpp"
#include "drive/stage.hpp"
#include "plan/registry.hpp"
#include "plan/stage.hpp"
#include "recover/registry.hpp"
#include "recover/stage.hpp"
#include "sense/registry.hpp"
#include "sense/stage.hpp"
#include "stages/additions.hpp"

namespace clew::stages {
namespace {

using runtime::BehaviourName;

std::vector<runtime::StageInfo>& stages() {
  static std::vector<runtime::StageInfo> stages = {sense::stage(),   classify::stage(),
                                                   plan::stage(),    recover::stage(),
                                                   control::stage(), drive::stage()};
  return stages;
}

void list(const runtime::VariantInfo& info, const std::string& stage_name,
          const std::string& part_name, std::vector<BehaviourName>& added) {
  for (runtime::StageInfo& stage : stages()) {
    for (runtime::PartInfo& part : stage.parts) {
      if (stage.name != stage_name || part.name != part_name) continue;
      part.variants.push_back(info);
      added.push_back({stage_name, part_name, info.name});
    }
  }
}

/// Adds them to the registry of a stage, and to each part that chooses from it.
template <typename Behaviour>
core::Result<void> add_each(std::vector<runtime::Registration<Behaviour>> registrations,
                            runtime::Registry<Behaviour>& registry, const std::string& stage,
                            const std::vector<std::string>& parts,
                            std::vector<BehaviourName>& added) {
  stages();  // copies the lists of the registries, so before there is more in them
  for (auto& registration : registrations) {
    const runtime::VariantInfo info = registration.info;
    const auto taken = registry.add(std::move(registration));
    if (!taken.ok()) return core::Error{stage + ": " + taken.error().message};
    for (const std::string& part : parts) list(info, stage, part, added);
  }
  return {};
}

}  // namespace

const std::vector<runtime::StageInfo>& all() { return stages(); }

core::Result<std::vector<BehaviourName>> add(Additions a) {
  std::vector<BehaviourName> added;
  const std::vector<std::string> one = {"behaviour"};
  CLEW_RETURN_IF_ERROR(add_each(std::move(a.sensors), sense::sensors(), "sense", one, added));
  CLEW_RETURN_IF_ERROR(
      add_each(std::move(a.classifiers), classify::classifiers(), "classify", one, added));
  CLEW_RETURN_IF_ERROR(add_each(std::move(a.planners), plan::planners(), "plan", one, added));
  CLEW_RETURN_IF_ERROR(add_each(std::move(a.detectors), recover::detectors(), "recover",
                                {"detector", "shadow"}, added));
  CLEW_RETURN_IF_ERROR(
      add_each(std::move(a.escapes), recover::escapes(), "recover", {"escape"}, added));
  CLEW_RETURN_IF_ERROR(
      add_each(std::move(a.controllers), control::controllers(), "control", one, added));
  CLEW_RETURN_IF_ERROR(add_each(std::move(a.drives), drive::drive_models(), "drive", one, added));
  return added;
}

}  // namespace clew::stages

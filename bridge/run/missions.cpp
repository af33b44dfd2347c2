// SPDX-License-Identifier: Apache-2.0
#include "run/missions.hpp"

#include <optional>
#include <string>
#include <utility>

#include "core/yaml_reader.hpp"
#include "runtime/config_source.hpp"
#include "runtime/goals.hpp"

namespace clew::bridge {
namespace {

using core::Result;
using runtime::kGoalChange;
using world::Goals;

/// The way-points of the recorded world, with other goals in the place of its own.
Result<std::vector<world::Waypoint>> waypoints_to(const runtime::Bundle& bundle,
                                                  const std::optional<Goals>& goals) {
  const auto file = runtime::BundleSource(bundle).find("worlds", "world");
  if (!file.ok()) return file.error();
  const auto world = world::World::parse(file->text, file->file, goals);
  if (!world.ok()) return world.error();
  return world->waypoints();
}

/// What the recorded graph says of its goals.
Result<std::optional<Goals>> goals_of_graph(const runtime::Bundle& bundle) {
  if (bundle.count("graph.yaml") == 0) return std::optional<Goals>();
  const auto file = runtime::BundleSource(bundle).find("graphs", "graph");
  if (!file.ok()) return file.error();
  const auto root = core::YamlNode::parse(file->text, file->file);
  if (!root.ok()) return root.error();
  const auto goals = runtime::read_goals(*root);
  if (!goals.ok()) return goals.error();
  return *goals ? std::optional((*goals)->goals) : std::nullopt;
}

}  // namespace

Result<std::vector<GivenMission>> missions_of(
    const runtime::Bundle& bundle, const std::vector<domain::Intervention>& interventions) {
  const auto goals = goals_of_graph(bundle);
  if (!goals.ok()) return goals.error();
  auto first = waypoints_to(bundle, *goals);
  if (!first.ok()) return first.error();
  std::vector<GivenMission> missions = {{0, std::move(first).value()}};
  for (const domain::Intervention& intervention : interventions) {
    for (const std::string& change : intervention.changes) {
      if (change.rfind(kGoalChange, 0) != 0) continue;
      auto given = runtime::parse_goals(change.substr(std::string(kGoalChange).size()));
      if (!given.ok()) return given.error();
      auto waypoints = waypoints_to(bundle, std::move(given).value());
      if (!waypoints.ok()) return waypoints.error();
      missions.push_back({intervention.tick, std::move(waypoints).value()});
    }
  }
  return missions;
}

}  // namespace clew::bridge

// SPDX-License-Identifier: Apache-2.0
#include "plan/stage.hpp"

#include <string>
#include <utility>

#include "plan/known_map.hpp"
#include "plan/plan_component.hpp"
#include "plan/registry.hpp"

namespace clew::plan {
namespace {

enum class MapKind : std::uint8_t { kWorld, kFile };

/// Parameters of every plan stage: what is known of the place.
struct MapParameters {
  MapKind map = MapKind::kWorld;
  std::string map_file;
  double cell_m = 0.05;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, MapParameters& p) {
  visit.choice("map", p.map, {{"world", MapKind::kWorld}, {"file", MapKind::kFile}},
               "what is known: the world's obstacles that do not move, or the map in map_file");
  visit.file("map_file", p.map_file, "maps", "a map of ROS's map_server, for map: file");
  visit.number("cell_m", p.cell_m, "m", {0.01, 1.0}, "side of the cells, for map: world");
}

core::Result<std::unique_ptr<MapSource>> make_map(const MapParameters& parameters,
                                                  const runtime::RunSetup& setup) {
  if (parameters.map == MapKind::kWorld) {
    auto map = WorldMap::create(setup.world, parameters.cell_m);
    if (!map.ok()) return map.error();
    return std::unique_ptr<MapSource>(std::move(map).value());
  }
  if (parameters.map_file.empty()) {
    return core::Error{"plan.map is file, and plan.map_file names none", {}, 0, 0};
  }
  auto map = FileMap::create(setup.behaviour.resources, parameters.map_file);
  if (!map.ok()) return map.error();
  return std::unique_ptr<MapSource>(std::move(map).value());
}

core::Result<std::unique_ptr<runtime::Component>> make(const runtime::StageConfig& config,
                                                       const runtime::RunSetup& setup) {
  auto map = make_map(core::read_parameters<MapParameters>(config.parameters), setup);
  if (!map.ok()) return map.error();
  auto planner = planners().make(config.part("behaviour"), setup.behaviour);
  if (!planner.ok()) return planner.error();
  return std::unique_ptr<runtime::Component>(
      std::make_unique<PlanComponent>(std::move(planner).value(), std::move(map).value(), setup));
}

}  // namespace

const runtime::StageInfo& stage() {
  static const runtime::StageInfo info = {"plan",
                                          "subgoals on the way to the mission's target",
                                          PlanComponent::ports(),
                                          core::describe_parameters<MapParameters>(),
                                          {{"behaviour", false, planners().variants()}},
                                          [](const runtime::StageConfig&) { return 0.0; },
                                          nullptr,
                                          make};
  return info;
}

}  // namespace clew::plan

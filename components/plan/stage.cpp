// SPDX-License-Identifier: Apache-2.0
#include "plan/stage.hpp"

#include <string>
#include <utility>

#include "plan/known_map.hpp"
#include "plan/plan_component.hpp"
#include "plan/registry.hpp"
#include "plan/seen_source.hpp"

namespace clew::plan {
namespace {

enum class MapKind : std::uint8_t { kWorld, kFile, kSeen };

/// Parameters of every plan stage: what is known of the place.
struct MapParameters {
  MapKind map = MapKind::kWorld;
  std::string map_file;
  double cell_m = 0.05;
  double margin_m = 0.1;
  std::int64_t capacity_tiles = 4096;
  double hit_spread_m = 0.1;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, MapParameters& p) {
  visit.choice("map", p.map,
               {{"world", MapKind::kWorld}, {"file", MapKind::kFile}, {"seen", MapKind::kSeen}},
               "source of the map: the world's obstacles that do not move, the map in map_file, or "
               "what the robot has seen so far");
  visit.file("map_file", p.map_file, "maps", "a map of ROS's map_server, for map: file");
  visit.number("cell_m", p.cell_m, "m", {0.01, 1.0}, "side of the cells, for map: world and seen");
  visit.number("margin_m", p.margin_m, "m", {0.0, 2.0},
               "clearance beside the robot that is left to its controller");
  visit.integer("capacity_tiles", p.capacity_tiles, "1", {1, 1000000},
                "greatest number of tiles of 32 by 32 cells that are kept, for map: seen");
  visit.number(
      "hit_spread_m", p.hit_spread_m, "m", {0.0, 0.3},
      "an obstacle is certain if the arc on which it must lie is at most this long, for map: seen");
}

template <typename Map>
core::Result<std::unique_ptr<MapSource>> as_source(core::Result<std::unique_ptr<Map>> map) {
  if (!map.ok()) return map.error();
  return std::unique_ptr<MapSource>(std::move(map).value());
}

core::Result<std::unique_ptr<MapSource>> make_map(const MapParameters& p,
                                                  const runtime::RunSetup& setup) {
  const RoomNeeds needs{setup.behaviour.robot.radius_m, p.margin_m};
  if (p.map == MapKind::kWorld) return as_source(WorldMap::create(setup.world, p.cell_m, needs));
  if (p.map == MapKind::kSeen) {
    const map::LocalMapParameters seen{0.5 * p.cell_m, p.capacity_tiles, p.hit_spread_m};
    return std::unique_ptr<MapSource>(std::make_unique<SeenSource>(seen, needs));
  }
  if (p.map_file.empty()) {
    return core::Error{"plan.map is file, and plan.map_file names none"};
  }
  auto map = FileMap::create(setup.behaviour.resources, p.map_file, needs);
  if (!map.ok()) return map.error();
  CLEW_RETURN_IF_ERROR((*map)->check_covers("start", setup.world->start().position()));
  for (const world::Waypoint& waypoint : setup.world->waypoints()) {
    CLEW_RETURN_IF_ERROR((*map)->check_covers("target", waypoint.place));
  }
  return as_source(std::move(map));
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
                                          "leads to the mission's target by subgoals",
                                          PlanComponent::ports(),
                                          core::describe_parameters<MapParameters>(),
                                          {{"behaviour", false, planners().variants()}},
                                          [](const runtime::StageConfig&) { return 0.0; },
                                          nullptr,
                                          make,
                                          nullptr,
                                          /*knows_world=*/true,
                                          {{"subgoals", "world_subgoals"}}};
  return info;
}

}  // namespace clew::plan

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "core/resources.hpp"
#include "core/result.hpp"
#include "map/ros_map.hpp"
#include "plan/map_source.hpp"
#include "world/world.hpp"

namespace clew::plan {

/// The obstacles of a world that do not move; room is exact at the middles of its cells.
class WorldMap final : public MapSource {
 public:
  /// The error says which cells would do, if these are more than map::kMaxMapCells.
  static core::Result<std::unique_ptr<WorldMap>> create(std::shared_ptr<const world::World> world,
                                                        double cell_m);

  map::RoomMap read(double reach_m) const override;

 private:
  WorldMap(std::shared_ptr<const world::World> world, const map::Grid& grid)
      : world_(std::move(world)), grid_(grid) {}

  std::shared_ptr<const world::World> world_;
  map::Grid grid_;
};

/// A map of ROS's map_server.
class FileMap final : public MapSource {
 public:
  static core::Result<std::unique_ptr<FileMap>> create(const core::Resources& resources,
                                                       const std::string& name);

  map::RoomMap read(double reach_m) const override { return map::room_around(map_, reach_m); }

 private:
  explicit FileMap(map::BlockedMap map) : map_(std::move(map)) {}

  map::BlockedMap map_;
};

}  // namespace clew::plan

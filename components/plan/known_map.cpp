// SPDX-License-Identifier: Apache-2.0
#include "plan/known_map.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace clew::plan {

using core::Result;

Result<std::unique_ptr<WorldMap>> WorldMap::create(std::shared_ptr<const world::World> world,
                                                   double cell_m) {
  const core::Vec2 size = world->bounds_max() - world->bounds_min();
  const double columns = std::ceil(size.x() / cell_m);
  const double rows = std::ceil(size.y() / cell_m);
  const auto allowed = static_cast<double>(map::kMaxMapCells);
  if (columns * rows > allowed) {
    // A little more than the root, for the cells that are cut by the border.
    const double enough_m = 1.01 * std::sqrt(size.x() * size.y() / allowed);
    return core::Error{
        fmt::format("plan.cell_m {} m makes {:.0f} cells of a world of {} m x {} m; allowed: at "
                    "most {}, as with {:.2g} m",
                    cell_m, columns * rows, size.x(), size.y(), map::kMaxMapCells, enough_m),
        {},
        0,
        0};
  }
  const map::Grid grid{world->bounds_min(), cell_m, static_cast<std::int32_t>(columns),
                       static_cast<std::int32_t>(rows)};
  return std::unique_ptr<WorldMap>(new WorldMap(std::move(world), grid));
}

map::RoomMap WorldMap::read(double reach_m) const {
  map::RoomMap map{grid_, std::vector<float>(grid_.size())};
  for (std::size_t i = 0; i < grid_.size(); ++i) {
    const core::Vec2 middle = grid_.centre(grid_.cell(i));
    map.room_m[i] = static_cast<float>(world_->standing_clearance_m(middle, reach_m));
  }
  return map;
}

Result<std::unique_ptr<FileMap>> FileMap::create(const core::Resources& resources,
                                                 const std::string& name) {
  const auto file = resources.find("maps", name);
  if (!file.ok()) return file.error();
  auto map = map::read_ros_map(*file);
  if (!map.ok()) return map.error();
  return std::unique_ptr<FileMap>(new FileMap(std::move(map).value()));
}

}  // namespace clew::plan

// SPDX-License-Identifier: Apache-2.0
#include "plan/known_map.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "map/line_of_sight.hpp"

namespace clew::plan {

using core::Result;

void KnownMap::measure_once() {
  if (!room_.empty()) return;
  const map::RoomMap measured = measure(needs_.radius_m + needs_.margin_m);
  grid_ = measured.grid;
  room_.assign(grid_.size(), map::Clearance::kNone);
  const auto mark = [&](double room_m, map::Clearance room) {
    measured.passable(room_m, passable_);
    for (std::size_t i = 0; i < room_.size(); ++i) {
      if (passable_[i] != 0) room_[i] = room;
    }
  };
  mark(needs_.radius_m, map::Clearance::kNarrow);
  mark(needs_.radius_m + needs_.margin_m, map::Clearance::kOpen);
}

RoomView KnownMap::read(const core::Vec2&, const core::Vec2&) {
  measure_once();
  return {grid_, room_};
}

bool KnownMap::line_of_sight(const core::Vec2& from, const core::Vec2& to, map::Clearance least) {
  measure_once();
  if (passable_room_ != least) {
    for (std::size_t i = 0; i < room_.size(); ++i) passable_[i] = room_[i] >= least ? 1 : 0;
    passable_room_ = least;
  }
  return map::line_of_sight(grid_, passable_, from, to);
}

Result<std::unique_ptr<WorldMap>> WorldMap::create(std::shared_ptr<const world::World> world,
                                                   double cell_m, const RoomNeeds& needs) {
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
                    cell_m, columns * rows, size.x(), size.y(), map::kMaxMapCells, enough_m)};
  }
  const map::Grid grid{world->bounds_min(), cell_m, static_cast<std::int32_t>(columns),
                       static_cast<std::int32_t>(rows)};
  return std::unique_ptr<WorldMap>(new WorldMap(std::move(world), grid, needs));
}

bool WorldMap::leads_straight(const core::Vec2& from, const core::Vec2& to) {
  constexpr double kStep_m = 0.01;
  // Half a step beside a place there may be less room, by so little.
  const double room_m = needs().radius_m - 1e-3;
  const int steps = static_cast<int>(std::ceil(core::length(to - from) / kStep_m));
  for (int i = 0; i <= steps; ++i) {
    const double share = steps > 0 ? static_cast<double>(i) / steps : 0.0;
    const core::Vec2 place = from + share * (to - from);
    if (world_->standing_clearance_m(place, needs().radius_m) < room_m) return false;
  }
  return true;
}

map::RoomMap WorldMap::measure(double reach_m) const {
  map::RoomMap map{cells_, std::vector<float>(cells_.size())};
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const core::Vec2 middle = cells_.centre(cells_.cell(i));
    map.room_m[i] = static_cast<float>(world_->standing_clearance_m(middle, reach_m));
  }
  return map;
}

Result<std::unique_ptr<FileMap>> FileMap::create(const core::Resources& resources,
                                                 const std::string& name, const RoomNeeds& needs) {
  const auto file = resources.find("maps", name);
  if (!file.ok()) return file.error();
  auto map = map::read_ros_map(*file);
  if (!map.ok()) return map.error();
  return std::unique_ptr<FileMap>(new FileMap(std::move(map).value(), file->file, needs));
}

Result<void> FileMap::check_covers(const std::string& what, const core::Vec2& place) const {
  const map::Grid& grid = map_.grid;
  if (grid.cell_at(place)) return {};
  const core::Vec2 end = grid.corner + grid.cell_m * core::Vec2(grid.columns, grid.rows);
  return core::Error{
      fmt::format("the map covers x from {} to {} m and y from {} to {} m, and the {} is at ({}, "
                  "{}): outside",
                  grid.corner.x(), end.x(), grid.corner.y(), end.y(), what, place.x(), place.y()),
      file_};
}

}  // namespace clew::plan

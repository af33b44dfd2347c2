// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/resources.hpp"
#include "core/result.hpp"
#include "map/ros_map.hpp"
#include "plan/map_source.hpp"
#include "world/world.hpp"

namespace clew::plan {

/// The room that a robot asks for.
struct RoomNeeds {
  double radius_m = 0.15;  ///< of the robot; with less room, there is none
  double margin_m = 0.1;   ///< beside the body; with less, a place is narrow
};

/// A map that is known from the start and does not change. It is measured at the first need, so
/// that to make one, and to check a graph, costs nothing; it has no state.
class KnownMap : public MapSource {
 public:
  void see(const domain::Odometry&, const domain::Scan&) override {}
  bool changes() const override { return false; }
  RoomView read(const core::Vec2& from, const core::Vec2& to) override;
  bool line_of_sight(const core::Vec2& from, const core::Vec2& to, map::Clearance least) override;
  bool leads_straight(const core::Vec2& from, const core::Vec2& to) override {
    return line_of_sight(from, to, map::Clearance::kNarrow);
  }
  void save(core::StateWriter&) const override {}
  void load(core::StateReader&) override {}

 protected:
  explicit KnownMap(const RoomNeeds& needs) : needs_(needs) {}

  const RoomNeeds& needs() const { return needs_; }
  /// The room around each cell, as far as `reach_m`.
  virtual map::RoomMap measure(double reach_m) const = 0;

 private:
  void measure_once();

  RoomNeeds needs_;
  map::Grid grid_;
  std::vector<map::Clearance> room_;
  std::vector<std::uint8_t> passable_;  // with passable_room_
  std::optional<map::Clearance> passable_room_;
};

/// The obstacles of a world that do not move; room is exact at the middles of its cells.
class WorldMap final : public KnownMap {
 public:
  /// The error says which cells would do, if these are more than map::kMaxMapCells.
  static core::Result<std::unique_ptr<WorldMap>> create(std::shared_ptr<const world::World> world,
                                                        double cell_m, const RoomNeeds& needs);

  /// Measured along the line itself: a way between two walls may be narrower than cells can tell.
  bool leads_straight(const core::Vec2& from, const core::Vec2& to) override;

 private:
  WorldMap(std::shared_ptr<const world::World> world, const map::Grid& grid, const RoomNeeds& needs)
      : KnownMap(needs), world_(std::move(world)), cells_(grid) {}

  map::RoomMap measure(double reach_m) const override;

  std::shared_ptr<const world::World> world_;
  map::Grid cells_;
};

/// A map of ROS's map_server.
class FileMap final : public KnownMap {
 public:
  static core::Result<std::unique_ptr<FileMap>> create(const core::Resources& resources,
                                                       const std::string& name,
                                                       const RoomNeeds& needs);

  /// Whether `place`, the start or the target, lies on the map: outside of it all is blocked, so no
  /// way begins or ends there. The error says what the map covers.
  core::Result<void> check_covers(const std::string& what, const core::Vec2& place) const;

 private:
  FileMap(map::BlockedMap map, std::string file, const RoomNeeds& needs)
      : KnownMap(needs), map_(std::move(map)), file_(std::move(file)) {}

  map::RoomMap measure(double reach_m) const override { return map::room_around(map_, reach_m); }

  map::BlockedMap map_;
  std::string file_;
};

}  // namespace clew::plan

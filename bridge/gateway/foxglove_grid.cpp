// SPDX-License-Identifier: Apache-2.0
#include "gateway/foxglove_grid.hpp"

#include <limits>
#include <nlohmann/json.hpp>

#include "core/base64.hpp"
#include "gateway/json_text.hpp"

namespace clew::bridge {
namespace {

using core::Vec2;
using nlohmann::ordered_json;

constexpr double kCell_m = 0.05;
constexpr std::uint64_t kPeriod_ns = 1000000000;
constexpr std::size_t kMostCells = 4 * 1024 * 1024;
/// Of foxglove.PackedElementField.
constexpr int kInt8 = 2;

map::LocalMapParameters parameters() {
  map::LocalMapParameters parameters;
  parameters.cell_m = kCell_m;
  return parameters;
}

/// The cells from the least tile to the greatest, row by row from below.
struct Cells {
  Vec2 corner = Vec2::Zero();
  std::size_t columns = 0;
  std::string values;
};

Cells cells_of(const map::SeenMap& seen) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vec2 least(kInfinity, kInfinity);
  Vec2 most = -least;
  for (const auto& [key, tile] : seen.state().tiles) {
    const Vec2 corner(key.first * seen.tile_m(), key.second * seen.tile_m());
    least = least.cwiseMin(corner);
    most = most.cwiseMax(corner + Vec2(seen.tile_m(), seen.tile_m()));
  }
  if (seen.state().tiles.empty()) return {};
  const Vec2 size = (most - least) / seen.cell_m();
  Cells cells{least, static_cast<std::size_t>(std::llround(size.x())), {}};
  const std::size_t count = cells.columns * static_cast<std::size_t>(std::llround(size.y()));
  if (count > kMostCells) return {};
  cells.values.assign(count, static_cast<char>(-1));
  const auto mark = [&](map::Mark kind, char value) {
    seen.for_each(kind, least, most, [&](const Vec2& place) {
      const Vec2 at = (place - least) / seen.cell_m();
      cells.values[static_cast<std::size_t>(at.y()) * cells.columns +
                   static_cast<std::size_t>(at.x())] = value;
    });
  };
  mark(map::Mark::kFree, 0);
  mark(map::Mark::kSuspected, 50);
  mark(map::Mark::kHit, 100);
  return cells;
}

}  // namespace

FoxgloveGrid::FoxgloveGrid(double radius_m) : map_(parameters(), radius_m) {}

void FoxgloveGrid::see(const domain::Odometry& odometry, const domain::Scan& scan) {
  map_.see(odometry, scan);
  has_seen_ = true;
}

std::optional<std::string> FoxgloveGrid::message(std::uint64_t time_ns, bool at_end) {
  const bool is_due = !sent_ns_ || time_ns >= *sent_ns_ + kPeriod_ns || at_end;
  if (!has_seen_ || !is_due) return std::nullopt;
  const Cells cells = cells_of(map_.seen());
  if (cells.columns == 0) return std::nullopt;
  sent_ns_ = time_ns;
  return json_text(
      {{"timestamp", {{"sec", time_ns / 1000000000}, {"nsec", time_ns % 1000000000}}},
       {"frame_id", "odom"},
       {"pose",
        {{"position", {{"x", cells.corner.x()}, {"y", cells.corner.y()}, {"z", 0.0}}},
         {"orientation", {{"x", 0.0}, {"y", 0.0}, {"z", 0.0}, {"w", 1.0}}}}},
       {"column_count", cells.columns},
       {"cell_size", {{"x", kCell_m}, {"y", kCell_m}}},
       {"row_stride", cells.columns},
       {"cell_stride", 1},
       {"fields", ordered_json::array({{{"name", "occupancy"}, {"offset", 0}, {"type", kInt8}}})},
       {"data", core::base64(cells.values)}});
}

}  // namespace clew::bridge

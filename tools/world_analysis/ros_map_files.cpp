// SPDX-License-Identifier: Apache-2.0
#include "world_analysis/ros_map_files.hpp"

#include <fmt/format.h>

#include <cmath>

namespace clew::world_analysis {
namespace {

using core::Vec2;

constexpr char kBlack = '\0';
constexpr char kWhite = '\xfe';  // as map_saver writes it
// A touch is one up to rounding.
constexpr double kRounding_m = 1e-9;

}  // namespace

RosMapFiles ros_map_of(const world::World& world, double cell_m) {
  const Vec2 corner = world.bounds_min();
  const Vec2 size = world.bounds_max() - corner;
  const auto columns = static_cast<int>(std::ceil(size.x() / cell_m - kRounding_m));
  const auto rows = static_cast<int>(std::ceil(size.y() / cell_m - kRounding_m));
  RosMapFiles files;
  files.head = fmt::format(
      "# SPDX-License-Identifier: Apache-2.0\n"
      "# build/ros-map {0} {1}\n"
      "image: {0}.pgm\n"
      "resolution: {1}\n"
      "origin: [{2}, {3}, 0]\n"
      "negate: 0\n"
      "occupied_thresh: 0.65\n"
      "free_thresh: 0.196\n",
      world.name(), cell_m, corner.x(), corner.y());
  files.picture = fmt::format("P5\n{} {}\n255\n", columns, rows);
  for (int row = rows; row-- > 0;) {
    for (int column = 0; column < columns; ++column) {
      const Vec2 middle = corner + cell_m * Vec2(column + 0.5, row + 0.5);
      const double reach_m = std::sqrt(0.5) * cell_m + kRounding_m;
      const bool is_free = world.standing_clearance_m(middle, cell_m) > reach_m;
      files.picture += is_free ? kWhite : kBlack;
    }
  }
  return files;
}

}  // namespace clew::world_analysis

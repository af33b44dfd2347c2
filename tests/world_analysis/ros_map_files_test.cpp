// SPDX-License-Identifier: Apache-2.0
#include "world_analysis/ros_map_files.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "map/ros_map.hpp"
#include "small_world.hpp"
#include "tests/source_path.hpp"

namespace clew::world_analysis {
namespace {

std::string read(const std::string& path) {
  std::stringstream text;
  text << std::ifstream(tests::source_path(path), std::ios::binary).rdbuf();
  return text.str();
}

TEST(RosMapFiles, AreBlackWhereAnObstacleIsWithinACell) {
  // A disc in the middle of a cell of 0.5 m, that of x and y from 5 to 5.5, and one that moves.
  const world::World world = small_world(
      "circles: [[5.25, 5.25, 0.1]]\n"
      "moving: [{circle: [2.2, 2.2, 0.2], path: [[0, 2.2, 2.2], [5, 2.2, 8]]}]",
      "[3, 3, 0]", "[7, 3]");

  const RosMapFiles files = ros_map_of(world, 0.5);

  const auto map = map::read_ros_map({"small.yaml", files.head, files.picture});
  ASSERT_TRUE(map.ok()) << map.error().text();
  ASSERT_EQ(map->grid.columns, 20);
  ASSERT_EQ(map->grid.rows, 20);
  for (std::size_t i = 0; i < map->grid.size(); ++i) {
    const map::Cell cell = map->grid.cell(i);
    const bool at_wall = cell.column % 19 == 0 || cell.row % 19 == 0;
    const bool at_disc = cell == map::Cell{10, 10};
    EXPECT_EQ(map->blocked[i] != 0, at_wall || at_disc) << cell.column << ", " << cell.row;
  }
}

TEST(RosMapFiles, GiveTheShippedMapByteForByte) {
  const auto office =
      world::World::parse(read("/configs/worlds/office.yaml"), "office.yaml").value();

  const RosMapFiles files = ros_map_of(office, 0.1);

  EXPECT_EQ(files.head, read("/configs/maps/office.yaml"));
  EXPECT_TRUE(files.picture == read("/configs/maps/office.pgm"));
}

}  // namespace
}  // namespace clew::world_analysis

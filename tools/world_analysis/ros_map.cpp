// SPDX-License-Identifier: Apache-2.0
/// Writes the map of a world for ROS's map_server, and for plan's `map: file`:
///
///     build/ros-map WORLD CELL_M [FOLDER]
///
/// FOLDER/NAME.yaml and FOLDER/NAME.pgm, by the world's name; into this folder without one. The
/// shipped maps are `build/ros-map office 0.1 configs/maps`.
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>

#include "runtime/config_source.hpp"
#include "world_analysis/ros_map_files.hpp"

namespace clew::world_analysis {
namespace {

constexpr double kLeastCell_m = 0.01;
constexpr double kMostCell_m = 10.0;
constexpr int kBadInput = 2;

int complain(const std::string& what) {
  std::fprintf(stderr, "ros-map: %s\n", what.c_str());
  return kBadInput;
}

bool write(const std::string& file, const std::string& bytes) {
  std::ofstream stream(file, std::ios::binary);
  stream << bytes;
  stream.close();
  return stream.good();
}

int run(const std::string& name, const char* cell_text, const std::string& folder) {
  char* end = nullptr;
  const double cell_m = std::strtod(cell_text, &end);
  if (*end != '\0' || !(cell_m >= kLeastCell_m && cell_m <= kMostCell_m)) {
    return complain("CELL_M is '" + std::string(cell_text) + "'; allowed: 0.01 to 10");
  }
  const auto file = runtime::ConfigPath::from_environment().find("worlds", name);
  if (!file.ok()) return complain(file.error().text());
  const auto world = world::World::parse(file->text, file->file);
  if (!world.ok()) return complain(world.error().text());
  const RosMapFiles files = ros_map_of(*world, cell_m);
  const std::string path = folder + '/' + world->name();
  if (!write(path + ".yaml", files.head) || !write(path + ".pgm", files.picture)) {
    return complain(path + ".yaml and .pgm cannot be written: " + std::strerror(errno));
  }
  return 0;
}

}  // namespace
}  // namespace clew::world_analysis

int main(int argc, char** argv) {
  if (argc < 3 || argc > 4) {
    return clew::world_analysis::complain("expected WORLD CELL_M [FOLDER]");
  }
  return clew::world_analysis::run(argv[1], argv[2], argc == 4 ? argv[3] : ".");
}

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <climits>
#include <cstdlib>
#include <system_error>

#include "encounters/encounter_bench.hpp"
#include "files/whole_file.hpp"

namespace clew::encounters {
namespace {

using core::Result;

constexpr char kLicence[] = "# SPDX-License-Identifier: Apache-2.0\n";

/// A text in the double quotes of YAML.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (byte < 0x20 || byte == 0x7f) {
      out += fmt::format("\\x{:02x}", byte);
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string fleet_text(const Encounter& encounter, const std::string& world_path) {
  const fleet::FleetFile& file = encounter.fleet;
  std::string text = fmt::format(
      "{}format: clew-fleet/1\nabout: {}\nworld: {}\nseed: {}\nmax_ticks: {}\nrobots:\n", kLicence,
      quoted(file.about), quoted(world_path), *file.seed, *file.max_ticks);
  for (const fleet::RobotEntry& robot : file.robots) {
    text += fmt::format("  - {{name: {}, graph: {}, start: [{}, {}, {}], target: [{}, {}, {}]}}\n",
                        robot.name, quoted(robot.graph), robot.start.x_m, robot.start.y_m,
                        robot.start.heading_rad, robot.target.x(), robot.target.y(),
                        *robot.target_radius_m);
  }
  return text;
}

/// The whole path of a folder, which is made if it is not there.
Result<std::string> whole_path(const std::string& folder) {
  if (::mkdir(folder.c_str(), 0777) != 0 && errno != EEXIST) {
    return core::Error{"the folder cannot be made: " + std::generic_category().message(errno),
                       folder};
  }
  char* const found = ::realpath(folder.c_str(), nullptr);
  if (found == nullptr) return core::Error{std::generic_category().message(errno), folder};
  std::string path = found;
  std::free(found);
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode)) return path;
  return core::Error{"found a file; allowed: a folder", folder};
}

}  // namespace

Result<void> write_encounters(const EncounterOrder& order, const std::string& folder, bool force) {
  auto path = whole_path(folder);
  if (!path.ok()) return path.error();
  const auto encounters = make_encounters(order);
  for (const Encounter& encounter : encounters) {
    for (const char* ending : {".yaml", ".world.yaml"}) {
      const std::string file = *path + '/' + encounter.name + ending;
      struct stat status {};
      if (force || ::lstat(file.c_str(), &status) != 0) continue;
      return core::Error{"the file exists; give --force to overwrite it", file};
    }
  }
  for (const Encounter& encounter : encounters) {
    const std::string world = *path + '/' + encounter.name + ".world.yaml";
    CLEW_RETURN_IF_ERROR(files::write_file(world, kLicence + encounter.world));
    CLEW_RETURN_IF_ERROR(
        files::write_file(*path + '/' + encounter.name + ".yaml", fleet_text(encounter, world)));
  }
  return {};
}

}  // namespace clew::encounters

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "core/quoted.hpp"
#include "encounters/encounter_bench.hpp"
#include "files/whole_file.hpp"
#include "fleet/output_folder.hpp"

namespace clew::encounters {
namespace {

using core::Result;

constexpr char kLicence[] = "# SPDX-License-Identifier: Apache-2.0\n";

std::string fleet_text(const Encounter& encounter, const std::string& world_path) {
  const fleet::FleetFile& file = encounter.fleet;
  std::string text = fmt::format(
      "{}format: clew-fleet/1\nabout: {}\nworld: {}\nseed: {}\nmax_ticks: {}\nrobots:\n", kLicence,
      core::yaml_quoted(file.about), core::yaml_quoted(world_path), *file.seed, *file.max_ticks);
  for (const fleet::RobotEntry& robot : file.robots) {
    text += fmt::format("  - {{name: {}, graph: {}, start: [{}, {}, {}], target: [{}, {}, {}]}}\n",
                        robot.name, core::yaml_quoted(robot.graph), robot.start.x_m,
                        robot.start.y_m, robot.start.heading_rad, robot.target.x(),
                        robot.target.y(), *robot.target_radius_m);
  }
  return text;
}

}  // namespace

Result<void> write_encounters(const EncounterOrder& order, const std::string& folder, bool force) {
  const auto path = fleet::make_folder(folder);
  if (!path.ok()) return path.error();
  const auto encounters = make_encounters(order);
  for (const Encounter& encounter : encounters) {
    for (const char* ending : {".yaml", ".world.yaml"}) {
      CLEW_RETURN_IF_ERROR(fleet::check_new_file(*path + '/' + encounter.name + ending, force));
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

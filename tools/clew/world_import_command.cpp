// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <vector>

#include "clew/command_line.hpp"
#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "core/angle.hpp"
#include "files/whole_file.hpp"
#include "runtime/run_plan.hpp"
#include "world_import/world_import.hpp"

namespace clew::tools {
namespace {

struct WorldImportOptions {
  std::string source;
  std::string output;
  std::string robot = "disc-015";
  std::vector<double> start;
  std::vector<double> target;
  double target_radius_m = 0.0;
  double cell_m = 0.0;
  std::string unknown = "blocked";
  std::size_t scenario = 0;
};

core::Result<world_import::ImportOptions> read_options(const WorldImportOptions& typed) {
  world_import::ImportOptions options;
  if (!typed.start.empty()) {
    options.start =
        core::Pose2{typed.start[0], typed.start[1], core::wrap_angle_rad(typed.start[2])};
  }
  if (!typed.target.empty()) options.target = core::Vec2(typed.target[0], typed.target[1]);
  if (typed.target_radius_m > 0.0) options.target_radius_m = typed.target_radius_m;
  if (typed.cell_m > 0.0) options.cell_m = typed.cell_m;
  if (typed.unknown != "blocked" && typed.unknown != "free") {
    return core::Error{"found '" + typed.unknown + "'; allowed: blocked, free", "--unknown"};
  }
  options.unknown_is_blocked = typed.unknown == "blocked";
  if (typed.scenario > 0) options.scenario = typed.scenario;
  const auto configs = runtime::ConfigPath::from_environment();
  const auto file = configs.find("robots", typed.robot);
  if (!file.ok()) return file.error();
  const auto robot = runtime::read_robot(*file, typed.robot);
  if (!robot.ok()) return robot.error();
  options.robot_radius_m = robot->radius_m;
  return options;
}

int import_command(const WorldImportOptions& typed) {
  const auto options = read_options(typed);
  if (!options.ok()) return complain(options.error());
  const auto text = world_import::import_world(typed.source, *options);
  if (!text.ok()) return complain(text.error());
  const auto written = files::write_file(typed.output, *text);
  return written.ok() ? kExitGood : complain(written.error());
}

}  // namespace

void add_world_import(CLI::App& world, int& status) {
  constexpr double kMost_m = 1e6;
  const auto options = std::make_shared<WorldImportOptions>();
  CLI::App* app = world.add_subcommand("import", "Make a world of somebody else's file");
  app->add_option("source", options->source,
                  ".yaml of a ROS map, .world (Gazebo, BARN), .map or .scen (MovingAI), .pgm, .png")
      ->required();
  app->add_option("-o,--output", options->output, "the world file to write")
      ->required()
      ->check(given_name());
  app->add_option("--start", options->start, "x, y in m and heading in rad: 1 2 0 or 1,2,0")
      ->expected(3)
      ->delimiter(',')
      ->check(number_between(-kMost_m, kMost_m));
  app->add_option("--target", options->target, "x and y in m")
      ->expected(2)
      ->delimiter(',')
      ->check(number_between(-kMost_m, kMost_m));
  app->add_option("--target-radius", options->target_radius_m, "in m")
      ->check(number_between(1e-3, kMost_m));
  app->add_option("--resolution", options->cell_m, "m a cell, of files that do not tell")
      ->check(number_between(1e-3, 100.0));
  app->add_option("--unknown", options->unknown, "what unknown cells are: blocked or free")
      ->capture_default_str();
  app->add_option("--scenario", options->scenario, "line of a .scen file, from 1; else the last")
      ->check(CLI::PositiveNumber);
  app->add_option("--robot", options->robot, "a name or a path: it must fit")
      ->capture_default_str();
  app->callback([options, &status] { status = import_command(*options); });
}

}  // namespace clew::tools

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "bag_import/bag_import.hpp"
#include "clew/command_line.hpp"
#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "clew/json_line.hpp"
#include "log/log.hpp"
#include "stages/all.hpp"

namespace clew::tools {
namespace {

struct ImportOptions {
  bag_import::BagImport order;
  std::string robot;
  std::vector<double> target;
  bool json = false;
};

int import_command(ImportOptions options) {
  if (!options.robot.empty()) options.order.overrides.robot = options.robot;
  if (!options.target.empty()) {
    options.order.target = core::Vec2(options.target[0], options.target[1]);
  }
  const auto imported = bag_import::import_bag(options.order, stages::all());
  if (!imported.ok()) return complain(imported.error());
  if (!imported->laser_is_known) {
    logs::warning(
        "{}: its /tf_static does not tell where the laser stands; taken is the "
        "robot's centre",
        options.order.bag);
  }
  if (options.json) {
    fmt::print("{}\n", json_line({{"ticks", imported->ticks},
                                  {"sim_time_s", imported->sim_time_s},
                                  {"recording", options.order.output}}));
  } else {
    fmt::print("{} ticks, {:.1f} s: {}\n", imported->ticks, imported->sim_time_s,
               options.order.output);
  }
  return kExitGood;
}

}  // namespace

void add_import(CLI::App& main, int& status) {
  constexpr double kMost_m = 1e6;
  const auto options = std::make_shared<ImportOptions>();
  CLI::App* app = main.add_subcommand("import", "Make a recording of a bag of ROS 2");
  app->add_option("bag", options->order.bag, "a directory of rosbag2, or its .mcap file")
      ->required();
  app->add_option("-o,--output", options->order.output, "the recording to write")
      ->required()
      ->check(given_name());
  app->add_flag("--force", options->order.force, "replace what is there");
  app->add_option("--graph", options->order.graph, "whose stages step on it")
      ->capture_default_str();
  app->add_option("--robot", options->robot, "a name or a path; else the graph's");
  app->add_option("--with", options->order.overrides.with, "STAGE[.PART]=NAME[,NAME...]")
      ->allow_extra_args(false);
  app->add_option("--set", options->order.overrides.set, "STAGE[.PART][.NAME].PARAM=VALUE")
      ->allow_extra_args(false);
  app->add_option("--scan-topic", options->order.topics.scan, "else the only LaserScan");
  app->add_option("--odom-topic", options->order.topics.odometry, "else the only Odometry");
  app->add_option("--target", options->target, "x and y in the odometry frame; else the bag's end")
      ->expected(2)
      ->delimiter(',')
      ->check(number_between(-kMost_m, kMost_m));
  app->add_flag("--json", options->json, "print it as one JSON object");
  app->callback([options, &status] { status = import_command(*options); });
}

}  // namespace clew::tools

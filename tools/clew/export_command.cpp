// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "clew/command_line.hpp"
#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "export/csv_export.hpp"
#include "export/rosbag2_export.hpp"
#include "gateway/foxglove_export.hpp"
#include "log/log.hpp"
#include "ros2/names.hpp"
#include "stages/all.hpp"

namespace clew::tools {
namespace {

struct ExportOptions {
  std::string recording;
  std::string csv;
  std::string foxglove;
  std::string rosbag2;
  std::string node_namespace;
  bool force = false;
};

core::Result<void> export_all(const ExportOptions& options, const bridge::RunRecording& recording) {
  if (!options.csv.empty()) {
    CLEW_RETURN_IF_ERROR(exports::export_csv(recording, options.csv, options.force));
  }
  if (!options.foxglove.empty()) {
    CLEW_RETURN_IF_ERROR(bridge::export_foxglove(recording, options.foxglove, options.force));
  }
  if (!options.rosbag2.empty()) {
    CLEW_RETURN_IF_ERROR(exports::export_rosbag2(
        recording, {options.rosbag2, options.force, options.node_namespace}, stages::all()));
  }
  return {};
}

int export_command(const ExportOptions& options) {
  if (options.csv.empty() && options.foxglove.empty() && options.rosbag2.empty()) {
    return complain(
        {"export it as what? give --csv DIR, --foxglove FILE or --rosbag2 DIR", {}, 0, 0});
  }
  if (const auto good = ros2::check_namespace(options.node_namespace); !good.ok()) {
    return complain({good.error().message, "--namespace", 0, 0});
  }
  const auto recording = bridge::RunRecording::open(options.recording);
  if (!recording.ok()) return complain(recording.error());
  const auto exported = export_all(options, *recording);
  if (!exported.ok()) return complain(exported.error());
  if (const std::string why = recording->cut_off(); !why.empty()) {
    logs::warning("{}: {}; exported is what is there", recording->path(), why);
  }
  return kExitGood;
}

}  // namespace

void add_export(CLI::App& main, int& status) {
  const auto options = std::make_shared<ExportOptions>();
  CLI::App* app = main.add_subcommand("export", "Write a recording in another format");
  app->add_option("recording", options->recording, "of a run")->required();
  app->add_option("--csv", options->csv, "a table a topic in this directory");
  app->add_option("--foxglove", options->foxglove,
                  "FILE.mcap with channels for the panels of Foxglove and its like")
      ->check(given_name());
  app->add_option("--rosbag2", options->rosbag2, "a bag of ROS 2 Jazzy (MCAP) in this directory");
  app->add_option("--namespace", options->node_namespace, "of the bag's topics, as robot1");
  app->add_flag("--force", options->force, "replace what is there");
  app->callback([options, &status] { status = export_command(*options); });
}

}  // namespace clew::tools

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "clew/command_line.hpp"
#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "gateway/foxglove_export.hpp"

namespace clew::tools {
namespace {

struct ExportOptions {
  std::string recording;
  std::string foxglove;
  bool force = false;
};

int export_command(const ExportOptions& options) {
  const auto recording = bridge::RunRecording::open(options.recording);
  if (!recording.ok()) return complain(recording.error());
  const auto exported = bridge::export_foxglove(*recording, options.foxglove, options.force);
  if (!exported.ok()) return complain(exported.error());
  if (const std::string why = recording->cut_off(); !why.empty()) {
    fmt::print(stderr, "clew: {}: {}; exported is what is there\n", recording->path(), why);
  }
  return kExitGood;
}

}  // namespace

void add_export(CLI::App& main, int& status) {
  const auto options = std::make_shared<ExportOptions>();
  CLI::App* app = main.add_subcommand("export", "Write a recording in another format");
  app->add_option("recording", options->recording, "of a run")->required();
  app->add_option("--foxglove", options->foxglove,
                  "FILE.mcap with channels for the panels of Foxglove and its like")
      ->required()
      ->check(file_to_write());
  app->add_flag("--force", options->force, "overwrite what is there");
  app->callback([options, &status] { status = export_command(*options); });
}

}  // namespace clew::tools

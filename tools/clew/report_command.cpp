// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <filesystem>

#include "clew/command_line.hpp"
#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "files/whole_file.hpp"
#include "log/log.hpp"
#include "recording/run_recording.hpp"
#include "view/page_file.hpp"
#include "view/report.hpp"

namespace clew::tools {
namespace {

using core::Error;
using core::Result;

struct ReportOptions {
  std::vector<std::string> recordings;
  std::string output;
};

Result<view::ReportedRecording> read_recording(const std::string& path, const std::string& output) {
  const auto recording = bridge::RunRecording::open(path);
  if (!recording.ok()) return recording.error();
  if (!recording->missing_piece().empty()) {
    logs::warning("{}: {}; shown is what is there", recording->path(), recording->cut_off());
  }
  view::ReportedRecording reported{std::filesystem::path(path).filename().string(), {}};
  std::error_code ignored;
  for (const std::string& file : recording->files()) {
    if (std::filesystem::equivalent(file, output, ignored)) {
      return Error{"is a recording that the report is made of", output};
    }
    auto bytes = files::read_file(file);
    if (!bytes.ok()) return bytes.error();
    reported.bytes.push_back(std::move(bytes).value());
  }
  return reported;
}

Result<void> write_report(const ReportOptions& options) {
  if (view::page().empty()) return Error{view::kNoPage};
  std::vector<view::ReportedRecording> recordings;
  for (const std::string& path : options.recordings) {
    auto recording = read_recording(path, options.output);
    if (!recording.ok()) return recording.error();
    recordings.push_back(std::move(recording).value());
  }
  const auto text = view::report(view::page(), recordings);
  if (!text.ok()) return text.error();
  return files::write_file(options.output, *text);
}

}  // namespace

void add_report(CLI::App& main, int& status) {
  const auto options = std::make_shared<ReportOptions>();
  CLI::App* app = main.add_subcommand(
      "report", "Put recordings and the page that shows them into one HTML file");
  app->add_option("recording", options->recordings, "one or more, laid over each other")
      ->required();
  app->add_option("-o,--output", options->output, "FILE.html, which needs no server")
      ->required()
      ->check(given_name());
  app->callback([options, &status] {
    const auto written = write_report(*options);
    status = written.ok() ? kExitGood : complain(written.error());
  });
}

}  // namespace clew::tools

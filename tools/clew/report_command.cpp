// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <filesystem>

#include "clew/command_line.hpp"
#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "files/whole_file.hpp"
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

Result<view::ReportedFile> read_recording(const std::string& path) {
  const auto recording = bridge::RunRecording::open(path);
  if (!recording.ok()) return recording.error();
  if (recording->pieces() > 1) return Error{"is split into files, and a report shows one", path};
  auto bytes = files::read_file(path);
  if (!bytes.ok()) return bytes.error();
  return view::ReportedFile{std::filesystem::path(path).filename().string(),
                            std::move(bytes).value()};
}

Result<void> write_report(const ReportOptions& options) {
  if (view::page().empty()) return Error{view::kNoPage};
  std::error_code ignored;
  std::vector<view::ReportedFile> files;
  for (const std::string& path : options.recordings) {
    if (std::filesystem::equivalent(path, options.output, ignored)) {
      return Error{"is a recording that the report is made of", options.output};
    }
    auto file = read_recording(path);
    if (!file.ok()) return file.error();
    files.push_back(std::move(file).value());
  }
  const auto text = view::report(view::page(), files);
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

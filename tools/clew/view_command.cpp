// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>

#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "clew/page_runs.hpp"
#include "clew/plugin_options.hpp"
#include "gateway/view_content.hpp"
#include "line/command_desk.hpp"
#include "line/domain_lock.hpp"
#include "line/wake_up.hpp"
#include "log/log.hpp"
#include "plugins/plugin_loader.hpp"
#include "recording/run_recording.hpp"
#include "run/end_signals.hpp"
#include "run/sample_account.hpp"
#include "run/spool.hpp"
#include "view/page_file.hpp"

namespace clew::tools {
namespace {

using core::Result;

/// Of the recording that Foxglove viewers get.
constexpr std::size_t kMostHeldBytes = 256 * 1024 * 1024;
constexpr std::size_t kBatchBytes = 1024 * 1024;
constexpr auto kPassOnPeriod = std::chrono::milliseconds(16);

/// How often it is asked whether a run still goes on.
constexpr auto kAskPeriod = std::chrono::milliseconds(500);

struct ViewOptions {
  std::vector<std::string> recordings;
  std::vector<std::string> plugins;
  int port = 0;
};

/// Whether somebody means a run: no file, and what a domain or a run can be called.
bool is_run(const std::string& text) {
  std::error_code code;
  if (std::filesystem::exists(text, code)) return false;
  return text.size() <= bridge::RunName::kMostNameBytes &&
         text.find_first_not_of(
             "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.") ==
             std::string::npos;
}

/// Tells where the page of a run is, which the run opens if nobody has, and stays until the run is
/// over or a signal comes.
int view_run(const std::string& run) {
  bridge::EndSignals signals;
  auto answer = bridge::command_run(run, {bridge::RunCommand::Kind::kView});
  if (!answer.ok()) {
    return complain({answer.error().message + "; nor is there a file '" + run + "'", {}, 0, 0});
  }
  const bridge::RunCommand question{bridge::RunCommand::Kind::kStatus};
  fmt::print("view {}\n", answer->page);
  std::fflush(stdout);
  const bridge::WakeUp clock;
  while (answer.ok()) {
    clock.wait_beside({signals.descriptor()}, kAskPeriod);
    if (signals.take() != 0) return kExitInterrupted;
    answer = bridge::command_run(run, question);
  }
  return kExitGood;
}

/// Refused is here what a page could only fail to read.
Result<std::vector<bridge::ServedRecording>> open_all(const std::vector<std::string>& paths) {
  std::vector<bridge::ServedRecording> opened;
  for (const std::string& path : paths) {
    const auto recording = bridge::RunRecording::open(path);
    if (!recording.ok()) return recording.error();
    if (!recording->missing_piece().empty()) {
      logs::warning("{}: {}; shown is what is there", recording->path(), recording->cut_off());
    }
    auto served = bridge::ServedRecording::open(recording->files());
    if (!served.ok()) return served.error();
    opened.push_back(std::move(served).value());
  }
  return opened;
}

/// Foxglove viewers get all of the first recording, as if it were a run.
void fill(bridge::LiveStream& stream, const std::string& path) {
  const auto recording = bridge::RunRecording::open(path);
  if (!recording.ok()) return;
  stream.describe(recording->description_of_samples(), path);
  for (const domain::Intervention& each : recording->interventions()) {
    stream.add(bridge::spooled(each));
  }
  bridge::SampleStream samples = recording->samples();
  std::string spool;
  for (auto sample = samples.next(); sample.ok() && *sample; sample = samples.next()) {
    bridge::append_to_spool(**sample, spool);
    if (spool.size() < kBatchBytes) continue;
    stream.add(spool);
    spool.clear();
  }
  stream.add(spool);
  stream.end("a recording");
}

int view_command(const ViewOptions& options) {
  if (view::page().empty()) return complain({view::kNoPage, {}, 0, 0}, kExitFailed);
  for (const std::string& each : options.recordings) {
    if (!is_run(each)) continue;
    if (options.recordings.size() == 1 && options.port == 0) return view_run(each);
    return complain(
        {"run " + each + " has a page of its own, at a port of its own: name it alone", {}, 0, 0});
  }
  const auto loaded = bridge::load_plugins(options.plugins);
  if (!loaded.ok()) return complain(loaded.error());
  auto opened = open_all(options.recordings);
  if (!opened.ok()) return complain(opened.error());
  bridge::ViewContent content(view::page(), std::move(opened).value());
  bridge::LiveStream stream(kMostHeldBytes);
  if (!options.recordings.empty()) {
    content.offer_to_foxglove(stream, [&] { fill(stream, options.recordings.front()); });
  }
  const auto server = bridge::WebServer::listen(options.port, content);
  if (!server.ok()) return complain(server.error());
  // After the server, so that what waits for an answer goes before it.
  auto runs = PageRuns::create(content, options.recordings, options.plugins);
  if (!runs.ok()) return complain(runs.error(), kExitFailed);
  (*runs)->serve_with(**server);
  (*server)->repeat(kPassOnPeriod, [&stream] {
    stream.pass_on();
    return true;
  });
  fmt::print("view {}\n", (*server)->access().address());
  std::fflush(stdout);
  return (*server)->run() == 0 ? kExitGood : kExitInterrupted;
}

}  // namespace

void add_view(CLI::App& main, int& status) {
  const auto options = std::make_shared<ViewOptions>();
  CLI::App* app = main.add_subcommand(
      "view", "Show recordings or a run on a web page of this machine, until Ctrl-C");
  app->add_option("recording", options->recordings,
                  "laid over each other; or a run, by its name or domain; none: draw a world and "
                  "run a graph");
  app->add_option("--port", options->port, "of 127.0.0.1 (a free one)")
      ->check(CLI::Range(1, 65535));
  add_plugins(*app, options->plugins);
  app->callback([options, &status] { status = view_command(*options); });
}

}  // namespace clew::tools

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>

#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "clew/page_runs.hpp"
#include "gateway/gateway_process.hpp"
#include "gateway/view_content.hpp"
#include "recording/run_recording.hpp"
#include "run/spool.hpp"
#include "view/page_file.hpp"

namespace clew::tools {
namespace {

using core::Result;

/// Of the recording that Foxglove viewers get.
constexpr std::size_t kMostHeldBytes = 256 * 1024 * 1024;
constexpr std::size_t kBatchBytes = 1024 * 1024;
constexpr auto kPassOnPeriod = std::chrono::milliseconds(16);

struct ViewOptions {
  std::vector<std::string> recordings;
  int port = 0;
};

/// Refused is here what a page could only fail to read.
Result<std::vector<bridge::ServedFile>> open_all(const std::vector<std::string>& paths) {
  std::vector<bridge::ServedFile> files;
  for (const std::string& path : paths) {
    const auto recording = bridge::RunRecording::open(path);
    if (!recording.ok()) return recording.error();
    auto file = bridge::ServedFile::open(path);
    if (!file.ok()) return file.error();
    files.push_back(std::move(file).value());
  }
  return files;
}

/// Foxglove viewers get all of the first recording, as if it were a run.
void fill(bridge::LiveStream& stream, const std::string& path) {
  const auto recording = bridge::RunRecording::open(path);
  if (!recording.ok()) return;
  stream.describe(recording->description(), path);
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
  auto files = open_all(options.recordings);
  if (!files.ok()) return complain(files.error());
  bridge::ViewContent content(view::page(), std::move(files).value());
  bridge::LiveStream stream(kMostHeldBytes);
  if (!options.recordings.empty()) {
    content.offer_to_foxglove(stream, [&] { fill(stream, options.recordings.front()); });
  }
  const auto server = bridge::WebServer::listen(options.port, content);
  if (!server.ok()) return complain(server.error());
  // After the server, so that what waits for an answer goes before it.
  auto runs = PageRuns::create(content, options.recordings);
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
  CLI::App* app =
      main.add_subcommand("view", "Show recordings on a web page of this machine, until Ctrl-C");
  app->add_option("recording", options->recordings,
                  "laid over each other; none: draw a world and run a graph");
  app->add_option("--port", options->port, "of 127.0.0.1 (a free one)")
      ->check(CLI::Range(1, 65535));
  app->callback([options, &status] { status = view_command(*options); });
}

void add_gateway(CLI::App& main, int& status) {
  struct Ends {
    int socket = -1;
    int port = 0;
  };
  const auto ends = std::make_shared<Ends>();
  CLI::App* app = main.add_subcommand("gateway", "Serve the page of a run as this process");
  app->group("");
  app->add_option("--socket", ends->socket, "to the run")->required();
  app->add_option("--port", ends->port, "of 127.0.0.1")->required();
  app->callback([ends, &status] {
    status = bridge::run_gateway_process(ends->socket, ends->port, view::page());
  });
}

}  // namespace clew::tools

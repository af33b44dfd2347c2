// SPDX-License-Identifier: Apache-2.0
#include "clew/watched_run.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "clew/own_program.hpp"
#include "recorder/recording_sink.hpp"
#include "runtime/plugin_list.hpp"
#include "view/page_file.hpp"

namespace clew::tools {
namespace {

using core::Error;
using core::Result;

const char* outcome_word(const bridge::RunReport& report) {
  if (!report.aborted.empty() || !report.statistics.truth) return "aborted";
  switch (report.statistics.truth->outcome) {
    case domain::Outcome::kReached:
      return "reached";
    case domain::Outcome::kCollided:
      return "collided";
    case domain::Outcome::kUnreachable:
      return "unreachable";
    case domain::Outcome::kTimeout:
      return "timeout";
    case domain::Outcome::kRunning:
      break;
  }
  return "aborted";
}

}  // namespace

Result<std::unique_ptr<bridge::LiveFeed>> start_view(const RunOptions& options,
                                                     const runtime::RunPlan& plan,
                                                     const std::string& run) {
  if (!options.view) return std::unique_ptr<bridge::LiveFeed>();
  if (view::page().empty()) return Error{view::kNoPage, "--view", 0, 0};
  std::vector<std::string> gateway = {own_program(), "gateway"};
  for (const runtime::PluginInfo& plugin : runtime::loaded_plugins()) {
    gateway.insert(gateway.end(), {"--plugin", plugin.file});
  }
  auto feed = bridge::LiveFeed::start(gateway, *options.view, bridge::describe_run(plan),
                                      plan.graph.name, run);
  if (!feed.ok()) return feed.error();
  fmt::print("view {}\n", (*feed)->address());
  std::fflush(stdout);
  return feed;
}

void end_view(bridge::LiveFeed& feed, const bridge::RunReport& report,
              bridge::EndSignals& signals) {
  feed.end(outcome_word(report));
  if (feed.dropped_batches() > 0) {
    fmt::print(stderr, "clew: the view was too slow: {} batches of samples were not shown\n",
               feed.dropped_batches());
  }
  const bool asked_to_end = report.interrupted_by != 0;
  if (asked_to_end || ::isatty(STDIN_FILENO) == 0 || ::isatty(STDOUT_FILENO) == 0) return;
  fmt::print(stderr, "clew: the page stays until Ctrl-C\n");
  feed.wait(signals);
}

}  // namespace clew::tools

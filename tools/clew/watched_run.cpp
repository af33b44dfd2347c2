// SPDX-License-Identifier: Apache-2.0
#include "clew/watched_run.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "clew/own_program.hpp"
#include "clew/run_output.hpp"
#include "log/log.hpp"
#include "recorder/recording_sink.hpp"
#include "runtime/plugin_list.hpp"
#include "view/page_file.hpp"

namespace clew::tools {

using core::Error;
using core::Result;

bridge::RunView view_of(const runtime::RunPlan& plan) {
  return bridge::RunView(
      [&plan](int port, const std::string& run) -> Result<std::unique_ptr<bridge::LiveFeed>> {
        if (view::page().empty()) return Error{view::kNoPage};
        std::vector<std::string> gateway = {own_program(), "gateway"};
        for (const runtime::PluginInfo& plugin : runtime::loaded_plugins()) {
          gateway.insert(gateway.end(), {"--plugin", plugin.file});
        }
        return bridge::LiveFeed::start(gateway, port, bridge::describe_run(plan), plan.graph.name,
                                       run);
      });
}

Result<void> start_view(const RunOptions& options, const std::string& run, bridge::RunView& view) {
  if (!options.view) return {};
  CLEW_RETURN_IF_ERROR(view.open_at(*options.view, run));
  fmt::print("view {}\n", view.address());
  std::fflush(stdout);
  return {};
}

void end_view(const RunOptions& options, const bridge::RunView& view,
              const bridge::RunReport& report, bridge::EndSignals& signals) {
  bridge::LiveFeed* const feed = view.feed();
  if (feed == nullptr) return;
  const bool shown = feed->end(outcome_word(report), signals);
  if (feed->dropped_batches() > 0) {
    logs::warning("the view was too slow: {} batches of samples were not shown",
                  feed->dropped_batches());
  }
  const bool asked_to_end = !shown || report.interrupted_by != 0 || !options.view;
  if (asked_to_end || ::isatty(STDIN_FILENO) == 0 || ::isatty(STDOUT_FILENO) == 0) return;
  logs::info("the page stays until Ctrl-C");
  feed->wait(signals);
}

}  // namespace clew::tools

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "clew/run_options.hpp"
#include "core/result.hpp"
#include "gateway/live_feed.hpp"
#include "run/end_signals.hpp"
#include "run/run_report.hpp"
#include "runtime/run_plan.hpp"

namespace clew::tools {

/// Starts the page of a run that asks for one, and prints where it is; null for others. The page
/// commands the run under the name `run`.
core::Result<std::unique_ptr<bridge::LiveFeed>> start_view(const RunOptions& options,
                                                           const runtime::RunPlan& plan,
                                                           const std::string& run);

/// Tells the page how the run ended. On a terminal the page stays until Ctrl-C, since a run is
/// often over before anybody has looked; elsewhere it ends with the run.
void end_view(bridge::LiveFeed& feed, const bridge::RunReport& report, bridge::EndSignals& signals);

}  // namespace clew::tools

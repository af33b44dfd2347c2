// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "clew/run_options.hpp"
#include "core/result.hpp"
#include "gateway/run_view.hpp"
#include "run/end_signals.hpp"
#include "run/run_report.hpp"
#include "runtime/run_plan.hpp"

namespace clew::tools {

/// The page of a run, for whoever asks for it while the run goes on. The plan must outlive it.
bridge::RunView view_of(const runtime::RunPlan& plan);

/// Opens it if the run is to have one from the start, and prints where it is. It commands the run
/// under the name `run`.
core::Result<void> start_view(const RunOptions& options, const std::string& run,
                              bridge::RunView& view);

/// Tells the page, if there is one, how the run ended. On a terminal one that was there from the
/// start stays until Ctrl-C, since a run is often over before anybody has looked; else it ends with
/// the run.
void end_view(const RunOptions& options, const bridge::RunView& view,
              const bridge::RunReport& report, bridge::EndSignals& signals);

}  // namespace clew::tools

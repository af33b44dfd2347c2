// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/result.hpp"
#include "recorder/recording_sink.hpp"
#include "run/run_control.hpp"
#include "run/run_report.hpp"
#include "runtime/run_plan.hpp"
#include "supervisor/process_layout.hpp"

namespace clew::bridge {

/// Runs a plan as one process a stage, joined by DDS, until it has an outcome, a component dies, or
/// SIGINT or SIGTERM arrives; then no process is left. Errors are those that come before anything
/// is started; what goes wrong later is in the report. The recording, if there is to be one, is
/// made by one more process; its file must be reserved. `display` may be null, and `control`: then
/// nothing can be changed while the run goes on, and nobody sees it.
core::Result<RunReport> run_processes(const runtime::RunPlan& plan, const ProcessLayout& layout,
                                      const std::optional<RecordingOrder>& recording,
                                      const ProgressDisplay& display,
                                      const ProcessStart& start = {},
                                      RunControl* control = nullptr);

}  // namespace clew::bridge

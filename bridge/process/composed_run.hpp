// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/result.hpp"
#include "process/link.hpp"
#include "process/run_report.hpp"
#include "process/supervisor.hpp"
#include "runtime/run_plan.hpp"

namespace clew::bridge {

/// How to run a plan in one thread of this process.
struct ComposedLayout {
  Pace pace = Pace::kLockstep;
  double pace_factor = 1.0;
  bool hash = true;
};

/// Runs a plan composed, until it has an outcome or SIGINT or SIGTERM arrives. Samples are
/// serialised only for the hash and the recording. `recording` and `display` may be null.
core::Result<RunReport> run_composed(const runtime::RunPlan& plan, const ComposedLayout& layout,
                                     SampleSink* recording, const ProgressDisplay& display);

}  // namespace clew::bridge

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/result.hpp"
#include "recording/run_recording.hpp"
#include "run/composed_run.hpp"
#include "runtime/intervention.hpp"
#include "runtime/run_plan.hpp"
#include "supervisor/process_layout.hpp"

namespace clew::bridge {

/// A run whose recording was cut off, at the first tick that the recording does not have whole.
struct Resumption {
  std::vector<runtime::Intervention> interventions;  ///< that took effect, and that are planned
  runtime::PlanSequence plans;                       ///< from each of them on
  bool has_ended = false;                            ///< no tick is left to run
  ComposedStart composed;
  ProcessStart processes;
};

/// Brings every component of `plan`, the recording's own, into the state in which the recorded
/// inputs put it, so that the run goes on as if it had not been cut off. Samples of ticks that are
/// not whole, at the end, are passed over: they will be written again.
///
/// Refused: a plan with a third-party component that may have a state, a recording in which a
/// command was late (what the wall clock decided cannot be continued), in which a tick in between
/// lacks a sample, of whose components this version's write something else, or that ends before it
/// branched off another.
core::Result<Resumption> resume(const RunRecording& recording, const runtime::RunPlan& plan);

}  // namespace clew::bridge

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

#include "core/result.hpp"
#include "run/pace.hpp"
#include "run/run_report.hpp"
#include "run/sample_account.hpp"
#include "run/sample_sink.hpp"
#include "runtime/run_plan.hpp"

namespace clew::bridge {

/// How to run a plan in one thread of this process.
struct ComposedLayout {
  Pace pace = Pace::kLockstep;
  double pace_factor = 1.0;
  bool hash = true;
  OnRecordError on_record_error = OnRecordError::kStop;
};

/// A run that is under way: what has been is not run again.
struct ComposedStart {
  std::vector<runtime::Node> nodes;  ///< in the order of the graph; have stepped every earlier tick
  std::uint64_t next_tick = 0;
  domain::Messages messages;  ///< the samples of the tick before
  SampleAccount account;      ///< of all earlier ticks
  std::chrono::steady_clock::time_point started_at;
};

/// Runs a plan composed, until it has an outcome or SIGINT or SIGTERM arrives. Samples are
/// serialised only for the hash and the recording. `recording` and `display` may be null.
core::Result<RunReport> run_composed(const runtime::RunPlan& plan, const ComposedLayout& layout,
                                     SampleSink* recording, const ProgressDisplay& display);

/// The same from `start`. `recording` gets only what is run.
core::Result<RunReport> run_composed(const runtime::RunPlan& plan, ComposedStart start,
                                     const ComposedLayout& layout, SampleSink* recording,
                                     const ProgressDisplay& display);

}  // namespace clew::bridge

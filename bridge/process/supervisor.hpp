// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "process/journal.hpp"
#include "process/link.hpp"
#include "process/run_report.hpp"
#include "runtime/run_plan.hpp"

namespace clew::bridge {

/// How to run a plan as separate processes. Nothing here changes what is computed.
struct ProcessLayout {
  std::string program;                                  ///< the clew command
  std::string middleware = "cyclonedds";                ///< of stages that do not say
  std::map<std::string, std::string> stage_middleware;  ///< by stage
  std::optional<int> domain;                            ///< none: the first free one
  Pace pace = Pace::kLockstep;
  double pace_factor = 1.0;
  bool hash = true;
  std::set<std::string> external;             ///< stages that a person starts
  std::map<std::string, std::string> prefix;  ///< by stage: `gdb --args`
};

/// Receives what the components write, in order within each topic, and says up to which tick all
/// of it is safe.
class SampleSink {
 public:
  virtual ~SampleSink() = default;
  /// Takes a sample; an error ends the run.
  virtual core::Result<void> add(const SpooledSample& sample) = 0;
  /// Ticks below this one are complete.
  virtual std::uint64_t complete_ticks() const = 0;
};

/// Runs a plan as one process a stage, joined by DDS, until it has an outcome, a component dies, or
/// SIGINT or SIGTERM arrives; then no process is left. Errors are those that come before anything
/// is started; what goes wrong later is in the report. `recording` and `display` may be null.
core::Result<RunReport> run_processes(const runtime::RunPlan& plan, const ProcessLayout& layout,
                                      SampleSink* recording, const ProgressDisplay& display);

}  // namespace clew::bridge

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hunt/property.hpp"
#include "hunt/run_fields.hpp"
#include "recording/run_recording.hpp"
#include "run/sample_sink.hpp"
#include "runtime/run_plan.hpp"
#include "supervisor/process_layout.hpp"

namespace clew::hunt {

/// What of a graph a search holds fixed.
struct GraphChoice {
  std::string graph;
  std::vector<std::string> with;  ///< as in `clew run`
  std::vector<std::string> set;
  std::optional<std::string> robot;
  std::optional<std::uint64_t> max_ticks;
};

/// A run to judge: a graph in a world that need not be a file.
struct RunCase {
  GraphChoice graph;
  std::string world_text;
  std::string world_file;  ///< what the world is called, by errors and recordings
  std::uint64_t seed = 1;
};

/// How a run went.
struct CaseOutcome {
  FieldValues values;
  std::string hash;
  std::uint64_t ticks = 0;
};

/// A bench's settings: where files come from, and the stages.
struct Workshop {
  const runtime::ConfigSource& configs;
  const std::vector<runtime::StageInfo>& stages;
};

/// Reads and checks what a case runs. Refused: what `clew run` refuses, and a graph with a program
/// of somebody else's, since runs of a search take place in one process.
core::Result<runtime::RunPlan> plan_case(const RunCase& which, const Workshop& workshop);

/// Runs a case, composed. The values that the property does not use may be missing, if they cost
/// something to compute. None if the run was interrupted by a signal.
core::Result<std::optional<CaseOutcome>> run_case(const RunCase& which, const Property& property,
                                                  const Workshop& workshop);

/// The same of a run that is planned already. Values that only `property` would ask for are left
/// out without one; `recording`, which may be null, gets the samples. Refused, too: a program of
/// somebody else's.
core::Result<std::optional<CaseOutcome>> run_plan(const runtime::RunPlan& plan,
                                                  const Property* property,
                                                  bridge::SampleSink* recording);

/// Runs `plan` from `tick` of a recording on, as bridge::branch_off does; what is recorded before
/// that counts as the run's own.
core::Result<std::optional<CaseOutcome>> run_branch(const bridge::RunRecording& recording,
                                                    const runtime::RunPlan& recorded,
                                                    const runtime::RunPlan& plan,
                                                    std::uint64_t tick, const Property* property);

/// Runs a plan as processes, and shows its samples to `trace` afterwards. Refused, too: a run that
/// was aborted, with the reason.
core::Result<std::optional<CaseOutcome>> run_as_processes(const runtime::RunPlan& plan,
                                                          const bridge::ProcessLayout& layout,
                                                          const Property* property,
                                                          bridge::SampleSink* trace);

/// What two runs are compared by: `holds`, `fails` or `undecided`; without a property the outcome.
std::string verdict_word(const std::optional<Property>& property, const CaseOutcome& outcome);

/// Where the robot was at the end of each tick of a case.
core::Result<std::vector<core::Pose2>> track_of(const RunCase& which, const Workshop& workshop);

/// Runs a case with a recording, and draws it: `recording` may be removed afterwards.
core::Result<void> record_case(const RunCase& which, const Workshop& workshop,
                               const std::string& recording);

}  // namespace clew::hunt

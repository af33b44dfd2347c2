// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "core/result.hpp"
#include "recording/run_recording.hpp"
#include "replay/fed_node.hpp"
#include "runtime/intervention.hpp"
#include "runtime/run_plan.hpp"

namespace clew::bridge {

/// Refused: a recording of message types that this version does not have.
core::Result<void> check_message_types(const RunRecording& recording);

/// The plan of the run that was recorded, whatever its message types were: to show it, not to
/// replay.
core::Result<runtime::RunPlan> described_plan(const RunRecording& recording,
                                              const std::vector<runtime::StageInfo>& stages);

/// The plan of the run that was recorded, from the recording alone. Refused: what
/// check_message_types refuses, a bundle that lacks a file, and what runtime::prepare_run refuses.
core::Result<runtime::RunPlan> recorded_plan(const RunRecording& recording,
                                             const std::vector<runtime::StageInfo>& stages);

/// What was changed in a run that was recorded, and its plans from there on.
struct RecordedChanges {
  std::vector<runtime::Intervention> interventions;
  runtime::PlanSequence plans;
};

/// The changes of a recording to `plan`, the recorded one or another: those that took effect and,
/// with `and_planned`, those that were to. Refused: what runtime::change refuses, and in a black
/// box what a behaviour would have to be fed before the box begins.
core::Result<RecordedChanges> recorded_changes(const RunRecording& recording,
                                               const runtime::RunPlan& plan,
                                               const std::vector<runtime::StageInfo>& stages,
                                               bool and_planned = false);

/// The same with changes. Data files that the recording does not have, because only the changes
/// need them, come from `files`.
core::Result<runtime::RunPlan> changed_plan(const RunRecording& recording,
                                            const runtime::GraphOverrides& overrides,
                                            const runtime::ConfigSource& files,
                                            const std::vector<runtime::StageInfo>& stages);

/// Where a recording branched off the recording of another run, nothing if it did not: its samples
/// of earlier ticks are those of that run, and the robot took over the state that it had there.
core::Result<std::optional<HandOver>> branch_of(const RunRecording& recording);

/// Puts into a plan's bundle what its recording must tell if it goes on from another run: where,
/// and under `before_branch/` the files of `before` that are not the same in it.
void note_branch(const runtime::Bundle& before, const HandOver& robot, runtime::RunPlan& plan);

}  // namespace clew::bridge

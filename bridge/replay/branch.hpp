// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/result.hpp"
#include "recording/run_recording.hpp"
#include "replay/component_replay.hpp"
#include "replay/fed_node.hpp"
#include "run/composed_run.hpp"
#include "runtime/run_plan.hpp"
#include "supervisor/process_layout.hpp"

namespace clew::bridge {

/// Brings every component of `plan` into the state in which the recorded inputs of all ticks before
/// `tick` put it, so that run_composed goes on from there: what would this plan have done from
/// here? Only the robot's is the state that `recorded`, the recording's own plan, gives: a changed
/// drive begins where the recorded one stands. The recorded samples of those ticks are accounted
/// for as the run's own. Time goes on in lockstep, so the last recorded command is never late.
///
/// Refused: a tick that is not between the run's first and its last one, one before the recording
/// itself branched off another, a plan with another duration of a tick or with a third-party
/// component, and a recording that does not begin at tick 0 or lacks a sample.
core::Result<ComposedStart> branch_off(const RunRecording& recording,
                                       const runtime::RunPlan& recorded,
                                       const runtime::RunPlan& plan, std::uint64_t tick);

/// The same as processes, for a plan with third-party components without a state. The samples
/// before `tick` come with it.
core::Result<ProcessStart> branch_off_processes(const RunRecording& recording,
                                                const runtime::RunPlan& recorded,
                                                const runtime::RunPlan& plan, std::uint64_t tick);

/// The robot's state at a branch after tick 0, for note_branch.
HandOver robot_of(const ComposedStart& start);
HandOver robot_of(const ProcessStart& start, const runtime::RunPlan& plan);

/// The first component of `recorded`, the recording's own plan, that does not do before `tick` what
/// is recorded: no branch can go on from there. Someone else's components are passed over, and of a
/// recording that is a branch itself the ticks before it began. With `only`, just that stage.
core::Result<std::optional<ReplayReport>> find_unfaithful(const RunRecording& recording,
                                                          const runtime::RunPlan& recorded,
                                                          std::uint64_t tick,
                                                          const std::string& only = {});

/// Gives the recorded samples of all ticks before `tick` to a recording of the branch.
core::Result<void> copy_samples_before(const RunRecording& recording, std::uint64_t tick,
                                       SampleSink& sink);

}  // namespace clew::bridge

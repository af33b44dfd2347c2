// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "recording/run_recording.hpp"
#include "runtime/run_plan.hpp"

namespace clew::bridge {

/// Refused: a recording of message types that this version does not have.
core::Result<void> check_message_types(const RunRecording& recording);

/// The plan of the run that was recorded, from the recording alone. Refused: a bundle that lacks a
/// file, and what runtime::prepare_run refuses.
core::Result<runtime::RunPlan> recorded_plan(const RunRecording& recording,
                                             const std::vector<runtime::StageInfo>& stages);

/// The same with changes. Data files that the recording does not have, because only the changes
/// need them, come from `files`.
core::Result<runtime::RunPlan> changed_plan(const RunRecording& recording,
                                            const runtime::GraphOverrides& overrides,
                                            const runtime::ConfigSource& files,
                                            const std::vector<runtime::StageInfo>& stages);

/// The tick from which a recording's samples are those of its own configuration: 0, or where it
/// branched off another run.
core::Result<std::uint64_t> first_own_tick(const RunRecording& recording);

/// Puts into a plan's bundle what its recording must tell if it goes on from `tick` of another run:
/// that tick, and under `before_branch/` the files that are not the same in it.
void note_branch(const runtime::Bundle& before, std::uint64_t tick, runtime::RunPlan& plan);

}  // namespace clew::bridge

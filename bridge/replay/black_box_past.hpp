// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/result.hpp"
#include "recording/run_recording.hpp"
#include "replay/fed_node.hpp"
#include "runtime/run_plan.hpp"

namespace clew::bridge {

/// The first tick that the components of a recording can be fed: 0, but for a black box.
std::uint64_t first_fed_tick(const RunRecording& recording);

/// What a recording that goes on from a black box has of its states: those of the stages that have
/// the same behaviours in `plan`. Nothing of another recording.
core::Result<std::optional<BlackBoxStart>> black_box_for(const RunRecording& recording,
                                                         const runtime::RunPlan& plan);

/// Lets a node of `plan` begin where the recording does: after a black box's first tick, in the
/// state that the box has of it. A node without a saved state starts fresh, and so does one with
/// other behaviours than those recorded. Does nothing if the recording begins at tick 0.
/// Refused: a state that is not one of the component's.
core::Result<void> begin_in_black_box(const RunRecording& recording, const runtime::RunPlan& plan,
                                      FedNode& fed);

/// Refused: a black box, of which `what` says what is not done.
core::Result<void> refuse_black_box(const RunRecording& recording, const std::string& what);

}  // namespace clew::bridge

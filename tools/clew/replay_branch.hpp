// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "clew/replay_options.hpp"
#include "recording/run_recording.hpp"
#include "runtime/run_plan.hpp"

namespace clew::tools {

/// `replay --branch`: checks that the recording is what `recorded` gives up to the tick, then runs
/// `plan` from there. Reports and returns like `clew run`; 1 if the check finds a difference.
int replay_branch(const ReplayOptions& options, const bridge::RunRecording& recording,
                  const runtime::RunPlan& recorded, const runtime::RunPlan& plan);

}  // namespace clew::tools

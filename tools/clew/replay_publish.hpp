// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "clew/replay_options.hpp"
#include "recording/run_recording.hpp"
#include "runtime/run_plan.hpp"

namespace clew::tools {

/// `replay --publish`: puts recorded topics on the wire; keys or commands steer it. Returns 0 if
/// all was taken and the component, if there is one, did what is recorded.
int replay_publish(const ReplayOptions& options, const bridge::RunRecording& recording,
                   const runtime::RunPlan& recorded, const runtime::RunPlan& plan);

}  // namespace clew::tools

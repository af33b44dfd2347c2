// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "core/result.hpp"
#include "recording/run_recording.hpp"
#include "replay/live_replay.hpp"
#include "runtime/run_plan.hpp"

namespace clew::bridge {

/// The topic of a name, with or without a slash before it. Refused: one that is not recorded; the
/// error tells the nearest name.
core::Result<domain::Topic> recorded_topic(const RunRecording& recording, const std::string& name);

/// What replay_live refuses of its options.
core::Result<void> check_live(const RunRecording& recording, const runtime::RunPlan& plan,
                              const LiveReplayOptions& options);

/// Whether a stage can be fed by a replay that publishes `topics` up to `last_tick`.
core::Result<void> check_fed(const RunRecording& recording, const runtime::GraphStage& stage,
                             const runtime::TopicSet& topics, std::uint64_t last_tick);

/// That a recording has no tick of a range.
core::Error no_tick_from(const RunRecording& recording, std::uint64_t first_tick);

}  // namespace clew::bridge

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "domain/inside.hpp"
#include "recording/run_recording.hpp"
#include "replay/sample_comparison.hpp"
#include "runtime/run_plan.hpp"

namespace clew::bridge {

struct ReplayRange {
  std::uint64_t first_tick = 0;  ///< compared; the state is built from the recording's first tick
  std::uint64_t last_tick = std::numeric_limits<std::uint64_t>::max();
  double rate = 0.0;  ///< simulated over wall-clock time; 0: as fast as the component takes it
};

/// The fields of one input.
struct InputFields {
  domain::Topic topic = domain::Topic::kCommand;
  std::vector<Field> fields;
};

/// How a component's outputs compare with those that were recorded.
struct ReplayReport {
  std::string component;
  std::uint64_t ticks = 0;                ///< compared
  std::uint64_t different_ticks = 0;      ///< of them
  std::optional<SampleDifference> first;  ///< a: recorded, b: replayed; in order of tick, topic
  std::vector<InputFields> inputs;        ///< of that tick
  bool has_past = true;                   ///< false: new where a black box begins
  double ticks_per_s = 0.0;               ///< fed, the building of the state included

  bool identical() const { return !first.has_value(); }
};

/// A stage of a recording's plan. Refused: one that it does not have.
core::Result<const runtime::GraphStage*> find_stage(const runtime::RunPlan& plan,
                                                    const std::string& stage);

/// Refused: a recording that lacks one of the topics, without which `stage` cannot be replayed.
core::Result<void> check_recorded(const RunRecording& recording, const std::string& stage,
                                  const runtime::TopicSet& topics);

/// Refused: a recording that lacks topics of its run, since the user left them out; `so` says what
/// cannot be done.
core::Result<void> refuse_left_out(const RunRecording& recording, const std::string& so);

/// Refused: a range without a tick.
core::Result<void> check_range(const ReplayRange& range);

/// Refused: a last tick beyond the recording's.
core::Result<void> check_last_tick(const RunRecording& recording, std::uint64_t last_tick);

/// Makes the component of a stage of `plan`, feeds it the recorded inputs and compares what it
/// writes with what is recorded, bit by bit. It is fed what was recorded also after a difference.
/// Of a recording that was cut off it takes the ticks of which its inputs are there. Refused: a
/// stage that the plan does not have or that is someone else's component, a recording that lacks a
/// topic or a sample that the component reads or writes, or ticks at its beginning without being a
/// black box, and an empty range.
core::Result<ReplayReport> replay_component(const RunRecording& recording,
                                            const runtime::RunPlan& plan, const std::string& stage,
                                            const ReplayRange& range = {});

/// What the component of a stage of `plan` tells of its inside at a tick, having been fed all that
/// was recorded for it up to there. Refused: as above, and a tick that the recording does not have.
core::Result<domain::Inside> inside_at(const RunRecording& recording, const runtime::RunPlan& plan,
                                       const std::string& stage, std::uint64_t tick);

/// The same of every tick that was recorded, in order. Refused: as above.
core::Result<void> for_each_inside(
    const RunRecording& recording, const runtime::RunPlan& plan, const std::string& stage,
    const std::function<void(std::uint64_t tick, const domain::Inside& inside)>& visit);

}  // namespace clew::bridge

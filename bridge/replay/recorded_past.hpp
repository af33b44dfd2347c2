// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "core/result.hpp"
#include "recording/run_recording.hpp"
#include "replay/fed_node.hpp"
#include "replay/tick_reader.hpp"
#include "run/composed_run.hpp"
#include "run/sample_account.hpp"
#include "runtime/run_plan.hpp"

namespace clew::bridge {

/// Makes recorded ticks the past of a run that goes on: every node steps them with the recorded
/// inputs, and the recorded samples are accounted for.
class RecordedPast {
 public:
  /// `nodes`, our own ones of `plan`, go on; but up to there the robot is the recorded one.
  /// Refused: what begin_in_black_box refuses.
  static core::Result<RecordedPast> begin(const RunRecording& recording,
                                          const runtime::RunPlan& plan,
                                          std::vector<runtime::NodeSuccession> nodes,
                                          FedNode recorded_robot);

  /// What a tick must hold.
  runtime::TopicSet topics() const;
  /// Adds the next tick. Refused: one that lacks a sample, and samples that are not valid.
  core::Result<void> add(const RecordedTick& recorded);
  /// Refused: a tick, the last that was added, of which the nodes did not write what is recorded.
  core::Result<void> check_outputs(const RecordedTick& recorded);

  bool has_ended() const;
  const std::vector<FedNode>& nodes() const { return fed_; }
  /// The samples of the last tick.
  const domain::Messages& messages() const { return messages_; }
  /// The run as it goes on; nothing may follow.
  core::Result<void> hand_over(ComposedStart& start);

 private:
  RecordedPast() = default;
  core::Result<void> account(domain::Topic topic, const RecordedTick& recorded);

  std::vector<FedNode> fed_;
  runtime::TopicSet not_ours_;  ///< what third-party components write
  std::optional<runtime::NodeSuccession> new_robot_;
  Codecs codecs_;
  domain::Messages messages_;
  SampleAccount account_{true, false};
};

/// The robot as it was recorded, to be fed.
core::Result<FedNode> recorded_robot(const RunRecording& recording,
                                     const runtime::RunPlan& recorded);

}  // namespace clew::bridge

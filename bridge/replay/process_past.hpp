// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "replay/recorded_past.hpp"
#include "run/sample_account.hpp"
#include "runtime/run_plan.hpp"
#include "supervisor/process_layout.hpp"

namespace clew::bridge {

/// Whether a component of the plan is a third party's: the plan cannot be composed.
bool has_third_party(const runtime::RunPlan& plan);

/// Our own components of a plan of which the others, if any, have no state: those can begin
/// anywhere. Refused: one that may have a state, which no recording has.
core::Result<std::vector<runtime::Node>> make_own_nodes(const runtime::RunPlan& plan);

/// What each component process of a run would have kept of a past that is recorded, third-party
/// ones without a state included.
class ProcessPast {
 public:
  /// With `spools`, for a new recording that begins with that past. The plan must outlive it.
  ProcessPast(const runtime::RunPlan& plan, bool spools);

  /// Adds the tick that `past` has taken up last.
  void add(const RecordedPast& past, const RecordedTick& recorded);
  /// Where the processes begin; nothing may follow.
  ProcessStart start(const RecordedPast& past, std::uint64_t tick);

 private:
  std::string node_of(const RecordedPast& past, const runtime::GraphStage& stage,
                      std::uint64_t tick) const;

  const runtime::RunPlan& plan_;
  std::vector<SampleAccount> accounts_;  ///< in the order of the stages
  SampleAccount observed_{true, false};  ///< of the topics that the observer reads
  SampleAccount spool_;
  std::array<std::string, domain::kTopicCount> last_outputs_;
};

}  // namespace clew::bridge

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "domain/inside.hpp"
#include "recording/run_recording.hpp"
#include "runtime/run_plan.hpp"

namespace clew::insides {

/// What a stage tells of a tick.
struct Explanation {
  std::string stage;
  std::string behaviour;  ///< the names of its parts, or the program of someone else's component
  domain::Inside inside;  ///< only a text of someone else's component
};

/// What all stages of a recorded run tell of a tick, in the order of the flow, or the one that is
/// named. Refused: a tick that the recording does not have, a stage that the run does not have, and
/// a named one that is someone else's component.
core::Result<std::vector<Explanation>> explain(const bridge::RunRecording& recording,
                                               const runtime::RunPlan& plan, std::uint64_t tick,
                                               const std::optional<std::string>& stage);

/// A paragraph with lines of at most `columns` characters, as far as words allow.
std::string wrapped(const std::string& paragraph, std::size_t columns);

}  // namespace clew::insides

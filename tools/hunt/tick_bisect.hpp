// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hunt/property.hpp"
#include "recording/run_recording.hpp"
#include "runtime/run_plan.hpp"

namespace clew::hunt {

/// What a change came to that was made at one tick.
struct TickProbe {
  std::uint64_t tick = 0;
  std::string outcome;
  std::string verdict;  ///< `holds`, `fails` or `undecided`; without a property the outcome
};

struct TickBisectEnd {
  TickProbe unchanged;            ///< the run as it was recorded
  std::vector<TickProbe> probes;  ///< by tick; the first is the first tick of all
  /// The last tick at which the change still gives another verdict, and one tick later it does not.
  /// None: it gives the recorded one at every tick that was tried.
  std::optional<std::uint64_t> last_tick;
  /// How often the verdict turns from one probe to the next. More than once: the change may help
  /// early and late, and not between.
  std::size_t turns = 0;
  bool interrupted = false;
};

/// When it is too late for a change: the recorded run is branched off with `changed` at evenly
/// spaced ticks, and where the verdict turns for the last time the tick is found by halving. A
/// verdict that turns and turns back between two of the evenly spaced ticks is not seen. A verdict
/// is whether `property` holds, or else the outcome.
///
/// Refused: what bridge::branch_off refuses, and a recording of components that do not do what is
/// recorded.
core::Result<TickBisectEnd> bisect_ticks(const bridge::RunRecording& recording,
                                         const runtime::RunPlan& recorded,
                                         const runtime::RunPlan& changed,
                                         const std::optional<Property>& property);

}  // namespace clew::hunt

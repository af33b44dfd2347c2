// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "runtime/stage.hpp"

namespace clew::view {

/// A rule base that was written on the page.
struct EditedRules {
  std::string place;  ///< the parameter that names it: `control.rules`
  std::string text;   ///< of the file
};

/// What a page wants of a run under way, checked: every word is one that the registry knows, or a
/// number.
struct PageOrder {
  std::string order;                 ///< pause, step, resume, stop, pace, goal or swap
  std::vector<std::string> changes;  ///< of goal and swap: domain::Intervention::changes
  std::vector<EditedRules> rules;    ///< of swap
  std::uint64_t ticks = 1;           ///< of step
  double pace_factor = 0.0;          ///< of pace: simulated over wall-clock time; 0: no limit
  std::vector<std::string> words;    ///< of the command line that does the same, behind the run
};

/// `{"order": "pause"}`, `{"order": "step", "ticks": 1}`, `{"order": "pace", "factor": 10}`,
/// `{"order": "goal", "x": 3, "y": 4}`, `{"order": "swap", "with": ..., "set": ...,
/// "rules": ...}` as read_branch takes them.
core::Result<PageOrder> read_order(std::string_view json,
                                   const std::vector<runtime::StageInfo>& stages);

}  // namespace clew::view

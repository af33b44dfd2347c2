// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "runtime/stage.hpp"
#include "view/page_order.hpp"

namespace clew::view {

/// A command of clew that the page asks for, checked: every word is one that its registry knows, or
/// a number. So a page names no program, no plug-in and no path.
struct PageCommand {
  std::size_t recording = 0;       ///< of a branch or a question: which of those that are served
  std::uint64_t tick = 0;          ///< of a branch or a question
  std::vector<std::string> words;  ///< behind `clew replay RECORDING` or `clew run GRAPH`
  std::string graph;               ///< of a run
  std::string world;               ///< of a run: a name; empty: `world_text`
  std::string world_text;          ///< a world that was drawn, as a file
  std::vector<EditedRules> rules;  ///< of a branch
  std::string what;                ///< for people: `branch at 100: recover.detector=none`
};

/// What may be named besides the registry.
struct KnownNames {
  std::vector<std::string> graphs;
  std::vector<std::string> worlds;
};

/// `{"recording": 0, "tick": 100, "with": {"recover.detector": ["none"]},
///   "set": [{"stage": "control", "part": "behaviour", "behaviour": "polar", "name": "speed_mps",
///            "value": 0.5}], "max_ticks": 2000}`; rule bases that were edited are
/// `"rules": [{"stage": "control", "part": "behaviour", "behaviour": "pin_bender", "name": "rules",
///             "text": "format: ..."}]`.
core::Result<PageCommand> read_branch(std::string_view json, std::size_t recordings,
                                      const std::vector<runtime::StageInfo>& stages);

/// `{"recording": 0, "tick": 100}`: what is told of a tick.
core::Result<PageCommand> read_question(std::string_view json, std::size_t recordings);

/// `{"graph": "default", "world": "u-trap", "with": ..., "set": ..., "max_ticks": 2000}`; for a
/// world that was drawn, `{"bounds": [4 numbers], "walls": [[4 numbers], ...], "start": [3],
/// "target": [2], "target_radius": 0.2}` in its name's place.
core::Result<PageCommand> read_run(std::string_view json, const KnownNames& names,
                                   const std::vector<runtime::StageInfo>& stages);

}  // namespace clew::view

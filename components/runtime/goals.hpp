// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "core/result.hpp"
#include "core/yaml_reader.hpp"
#include "world/world.hpp"

namespace clew::runtime {

/// What a graph says of where the run leads to, and where it stands.
struct GraphGoals {
  world::Goals goals;
  core::YamlNode where;
};

/// A graph's key `goal`, which is `[x, y]`, `[x, y, radius]` or `none` (the robot waits), or its
/// key `mission`, if that is a list of such places in their order. A mission may also be a word:
/// see MissionInfo.
core::Result<std::optional<GraphGoals>> read_goals(const core::YamlNode& graph);
/// What begins a change of the goals.
inline constexpr char kGoalChange[] = "goal=";
/// What stands behind that in a change of a run: `X,Y[,RADIUS]`, more of them after slashes, or
/// `none`.
core::Result<world::Goals> parse_goals(const std::string& text);

/// The change that parse_goals reads, `goal=` and all.
std::string goals_change(const world::Goals& goals);

/// The line of a graph file that says it; empty without goals.
std::string goals_yaml(const std::optional<world::Goals>& goals);

}  // namespace clew::runtime

// SPDX-License-Identifier: Apache-2.0
/// A place of a mission as world files, graph files and commands write it: one list of numbers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "core/yaml_reader.hpp"
#include "world/world.hpp"

namespace clew::world {

inline constexpr char kGoalForms[] =
    "[x, y], [x, y, radius], [x, y, radius, heading] or [x, y, radius, heading, tolerance]";

/// Reads one of kGoalForms: metres and radians; `~` in the place of the radius is the world's.
/// Refused: other lists, and what set_heading refuses. Whether the radius is positive and the place
/// is free is not looked at.
/// `forms` is what an error says is allowed.
core::Result<Goal> read_goal(const core::YamlNode& node, const char* forms = kGoalForms);

/// Sets a heading of `[heading]` or `[heading, tolerance]`. Refused: a heading beyond +-2 pi, which
/// is one in degrees, and a tolerance that is not above 0 and at most pi.
core::Result<void> set_heading(const core::YamlNode& node, const std::vector<double>& numbers,
                               GoalHeading& heading);

/// `1, 2`, `1, 2, 0.3, 1.5, 0.1`: what read_goal reads between its brackets, with `separator`
/// between the numbers.
std::string goal_numbers(const Goal& goal, const char* separator);

/// The line of a world file that names the heading at its target; empty without one.
std::string target_heading_yaml(const std::optional<GoalHeading>& heading);

}  // namespace clew::world

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "rules/rule_base.hpp"

namespace clew::rules {

/// The sets and surfaces of rule bases as an SVG file's text; the same rule bases give the same
/// bytes.
std::string draw(const std::string& graph, const std::vector<RuleBase>& bases);

/// A rule base for people: where each set is full and where it ends, the rules, and some values of
/// each surface.
std::string describe(const RuleBase& base);

/// The same with every value, as a line of JSON.
std::string to_json(const RuleBase& base);

}  // namespace clew::rules

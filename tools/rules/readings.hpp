// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/resources.hpp"
#include "core/result.hpp"
#include "rules/rule_base.hpp"

namespace clew::rules {

// Each fills in the variables, rules and surfaces of a rule base file of one format.

core::Result<void> read_krishna_kalra(const core::Resource& file, RuleBase& base);
core::Result<void> read_virtual_target(const core::Resource& file, RuleBase& base);
core::Result<void> read_behaviourist(const core::Resource& file, RuleBase& base);
core::Result<void> read_wall_following(const core::Resource& file, RuleBase& base);
core::Result<void> read_neuro_fuzzy(const core::Resource& file, RuleBase& base);

}  // namespace clew::rules

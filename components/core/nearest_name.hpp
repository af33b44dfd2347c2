// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace clew::core {

/// The one of `known` that `name` was probably meant to be: fewest edits (insertion, deletion,
/// replacement, swap of neighbours), at most a third of its letters and at least one; empty if none
/// is that near. The first of several equally near ones.
std::string nearest_name(std::string_view name, const std::vector<std::string>& known);

/// The answer to a name that does not exist: `unknown key 'rnage_m' (did you mean 'range_m'?);
/// allowed: noise_stddev_m, range_m`. `what` says what kind of name it is.
std::string unknown_name(std::string_view what, std::string_view name,
                         const std::vector<std::string>& known);

}  // namespace clew::core

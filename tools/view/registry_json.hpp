// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "runtime/stage.hpp"

namespace clew::view {

/// What a form needs to offer other behaviours and values: each stage's parts, their behaviours,
/// and the parameters of each with unit, range, choices, default and description.
nlohmann::ordered_json registry_json(const std::vector<runtime::StageInfo>& stages);

}  // namespace clew::view

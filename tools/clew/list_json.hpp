// SPDX-License-Identifier: Apache-2.0
/// What `clew list` prints, for programs.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "runtime/stage.hpp"

namespace clew::tools {

/// A stage: its ports, its parameters, its parts. With `part` and `name`, either may be empty, only
/// the behaviours that fit; the caller checks that there are any.
nlohmann::ordered_json json_of(const runtime::StageInfo& stage, const std::string& part,
                               const std::string& name);

/// The topics that the stages exchange: name, type, who writes it and who reads it.
nlohmann::ordered_json json_of_topics();

}  // namespace clew::tools

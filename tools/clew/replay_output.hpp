// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "replay/component_replay.hpp"

namespace clew::tools {

/// What `replay --json` prints of one component.
nlohmann::ordered_json replay_json(const bridge::ReplayReport& report);

/// The same for people: a line, and after a difference the fields and the inputs of its tick.
void print_replay(const bridge::ReplayReport& report);

}  // namespace clew::tools

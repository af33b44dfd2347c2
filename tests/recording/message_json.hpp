// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "domain/messages.hpp"

namespace clew::recording_test {

/// A message's fields by their names in idl/, as other readers of CDR give them: enumerators as
/// numbers; 64-bit integers as text, since JSON's numbers do not hold them.
nlohmann::json to_json(const domain::Command& m);
nlohmann::json to_json(const domain::Event& m);
nlohmann::json to_json(const domain::Guidance& m);
nlohmann::json to_json(const domain::Landmark& m);
nlohmann::json to_json(const domain::Odometry& m);
nlohmann::json to_json(const domain::Scan& m);
nlohmann::json to_json(const domain::State& m);
nlohmann::json to_json(const domain::Target& m);

}  // namespace clew::recording_test

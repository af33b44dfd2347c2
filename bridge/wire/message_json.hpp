// SPDX-License-Identifier: Apache-2.0
/// Messages as JSON and back: objects whose keys are the names in idl/.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/result.hpp"
#include "domain/topics.hpp"

namespace clew::bridge {

/// Every field of a message. An enumerator is its name in idl/; a number that JSON does not have is
/// null.
nlohmann::ordered_json json_of(domain::ConstMessagePointer message);

/// Fills a message from JSON of a program's: a field that is left out keeps its value. Refused,
/// with the field, what was found and what is allowed: names that are no field, values of another
/// type, lists that are too long, and what domain::validate refuses. `name` is the message's in
/// errors.
core::Result<void> read_json(const nlohmann::ordered_json& json, const std::string& name,
                             domain::MessagePointer message);

}  // namespace clew::bridge

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "domain/message_fields.hpp"

namespace clew::bridge {

/// A value as other readers of CDR give it: structs by the names of their fields in idl/,
/// enumerators as numbers; 64-bit integers as text, since JSON's numbers do not hold them.
template <typename Value>
nlohmann::json to_json(const Value& value) {
  if constexpr (domain::kIsStruct<Value>) {
    nlohmann::json object;
    domain::visit_named_fields(
        [&](const char* name, const auto& member) { object[name] = to_json(member); }, value);
    return object;
  } else if constexpr (domain::kIsSequence<Value> || domain::kIsArray<Value>) {
    nlohmann::json items = nlohmann::json::array();
    for (const auto& item : value) items.push_back(to_json(item));
    return items;
  } else if constexpr (std::is_enum_v<Value>) {
    return static_cast<int>(value);
  } else if constexpr (std::is_same_v<Value, std::uint64_t>) {
    return std::to_string(value);
  } else {
    return value;
  }
}

}  // namespace clew::bridge

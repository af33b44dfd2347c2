// SPDX-License-Identifier: Apache-2.0
#include "wire/message_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/nearest_name.hpp"
#include "domain/message_fields.hpp"

namespace clew::bridge {
namespace {

using core::Result;
using nlohmann::ordered_json;

constexpr std::size_t kLongestQuote = 40;

core::Error wrong(const std::string& path, const ordered_json& found, const std::string& allowed) {
  std::string text = found.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  if (text.size() > kLongestQuote) text = text.substr(0, kLongestQuote) + "...";
  return {fmt::format("{} is {}; allowed: {}", path, text, allowed)};
}

template <typename Value>
ordered_json json_of_value(const Value& value) {
  if constexpr (std::is_enum_v<Value>) {
    const auto index = static_cast<std::size_t>(value);
    CLEW_CHECK(index < domain::kEnumeratorNames<Value>.size(), std::to_string(index));
    return domain::kEnumeratorNames<Value>[index];
  } else if constexpr (std::is_same_v<Value, double>) {
    return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
  } else if constexpr (domain::kIsStruct<Value>) {
    ordered_json json = ordered_json::object();
    domain::visit_named_fields(
        [&](const char* name, const auto& member) { json[name] = json_of_value(member); }, value);
    return json;
  } else if constexpr (domain::kIsSequence<Value> || domain::kIsArray<Value>) {
    ordered_json json = ordered_json::array();
    for (const auto& item : value) json.push_back(json_of_value(item));
    return json;
  } else {
    return value;
  }
}

template <typename Value>
Result<void> read_value(const ordered_json& json, const std::string& path, Value& value);

template <typename Enum>
Result<void> read_enumerator(const ordered_json& json, const std::string& path, Enum& value) {
  const auto& names = domain::kEnumeratorNames<Enum>;
  const std::vector<std::string> known(names.begin(), names.end());
  if (!json.is_string()) return wrong(path, json, fmt::format("{}", fmt::join(known, ", ")));
  const auto found = std::find(known.begin(), known.end(), json.get<std::string>());
  if (found == known.end()) {
    return core::Error{core::unknown_name("value of " + path, json.get<std::string>(), known)};
  }
  value = static_cast<Enum>(found - known.begin());
  return {};
}

template <typename Whole>
Result<void> read_whole(const ordered_json& json, const std::string& path, Whole& value) {
  constexpr std::uint64_t kMost = std::numeric_limits<Whole>::max();
  if (!json.is_number_unsigned() || json.get<std::uint64_t>() > kMost) {
    return wrong(path, json, fmt::format("a whole number from 0 to {}", kMost));
  }
  value = static_cast<Whole>(json.get<std::uint64_t>());
  return {};
}

template <typename Struct>
Result<void> read_struct(const ordered_json& json, const std::string& path, Struct& value) {
  if (!json.is_object()) return wrong(path, json, "an object");
  std::vector<std::string> known;
  domain::visit_named_fields([&](const char* name, const auto&) { known.emplace_back(name); },
                             value);
  for (const auto& entry : json.items()) {
    if (std::find(known.begin(), known.end(), entry.key()) != known.end()) continue;
    return core::Error{core::unknown_name("field of " + path, entry.key(), known)};
  }
  Result<void> all;
  domain::visit_named_fields(
      [&](const char* name, auto& member) {
        const auto found = json.find(name);
        if (all.ok() && found != json.end()) all = read_value(*found, path + '.' + name, member);
      },
      value);
  return all;
}

template <typename List>
Result<void> read_list(const ordered_json& json, const std::string& path, List& value) {
  if (!json.is_array()) return wrong(path, json, "a list");
  std::size_t most = domain::kMaxRanges;
  if constexpr (domain::kIsArray<List>) {
    most = value.size();
    if (json.size() != most) return wrong(path, json, fmt::format("a list of {} items", most));
  } else {
    if constexpr (!std::is_same_v<List, std::vector<double>>) most = List::kCapacity;
    if (json.size() > most) return wrong(path, json, fmt::format("a list of up to {} items", most));
    value.resize(json.size());
  }
  for (std::size_t i = 0; i < json.size(); ++i) {
    CLEW_RETURN_IF_ERROR(read_value(json[i], fmt::format("{}[{}]", path, i), value[i]));
  }
  return {};
}

template <typename Value>
Result<void> read_value(const ordered_json& json, const std::string& path, Value& value) {
  if constexpr (std::is_enum_v<Value>) {
    return read_enumerator(json, path, value);
  } else if constexpr (std::is_same_v<Value, bool>) {
    if (!json.is_boolean()) return wrong(path, json, "true, false");
    value = json.get<bool>();
  } else if constexpr (std::is_same_v<Value, double>) {
    if (!json.is_number()) return wrong(path, json, "a number");
    value = json.get<double>();
  } else if constexpr (std::is_same_v<Value, std::string>) {
    if (!json.is_string()) return wrong(path, json, "a text");
    value = json.get<std::string>();
  } else if constexpr (std::is_integral_v<Value>) {
    return read_whole(json, path, value);
  } else if constexpr (domain::kIsStruct<Value>) {
    return read_struct(json, path, value);
  } else {
    return read_list(json, path, value);
  }
  return {};
}

}  // namespace

ordered_json json_of(domain::ConstMessagePointer message) {
  return std::visit([](const auto* one) { return json_of_value(*one); }, message);
}

Result<void> read_json(const ordered_json& json, const std::string& name,
                       domain::MessagePointer message) {
  return std::visit(
      [&](auto* one) -> Result<void> {
        CLEW_RETURN_IF_ERROR(read_value(json, name, *one));
        return domain::validate(*one);
      },
      message);
}

}  // namespace clew::bridge

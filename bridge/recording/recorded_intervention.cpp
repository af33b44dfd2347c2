// SPDX-License-Identifier: Apache-2.0
#include "recording/recorded_intervention.hpp"

#include <nlohmann/json.hpp>
#include <utility>

namespace clew::bridge {
namespace {

using nlohmann::ordered_json;

std::string text_of(const ordered_json& json) {
  return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

ordered_json content_of(const domain::Intervention& intervention) {
  ordered_json json;
  if (intervention.order.empty()) {
    json["fed_from"] = intervention.fed_from;
    json["changes"] = intervention.changes;
  } else {
    json["order"] = intervention.order;
  }
  return json;
}

std::optional<domain::Intervention> from(const ordered_json& json) {
  if (!json.is_object()) return std::nullopt;
  domain::Intervention intervention;
  if (json.contains("order")) {
    if (!json["order"].is_string() || json.contains("changes")) return std::nullopt;
    intervention.order = json["order"].get<std::string>();
    return intervention;
  }
  if (!json.contains("changes") || !json["changes"].is_array() || !json.contains("fed_from") ||
      !json["fed_from"].is_number_unsigned()) {
    return std::nullopt;
  }
  intervention.fed_from = json["fed_from"].get<std::uint64_t>();
  for (const ordered_json& change : json["changes"]) {
    if (!change.is_string()) return std::nullopt;
    intervention.changes.push_back(change.get<std::string>());
  }
  return intervention;
}

ordered_json parsed(std::string_view json) {
  return ordered_json::parse(json.begin(), json.end(), nullptr, false);
}

}  // namespace

std::string to_json(const domain::Intervention& intervention) {
  return text_of(content_of(intervention));
}

std::optional<domain::Intervention> intervention_from_json(std::uint64_t tick,
                                                           std::string_view json) {
  auto intervention = from(parsed(json));
  if (!intervention || intervention->fed_from > tick) return std::nullopt;
  intervention->tick = tick;
  return intervention;
}

std::string to_planned_json(const domain::Intervention& intervention) {
  ordered_json json = content_of(intervention);
  json["tick"] = intervention.tick;
  return text_of(json);
}

std::optional<domain::Intervention> planned_from_json(std::string_view json) {
  const ordered_json object = parsed(json);
  if (!object.is_object() || !object.contains("tick") || !object["tick"].is_number_unsigned()) {
    return std::nullopt;
  }
  return intervention_from_json(object["tick"].get<std::uint64_t>(), json);
}

}  // namespace clew::bridge

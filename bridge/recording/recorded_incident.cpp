// SPDX-License-Identifier: Apache-2.0
#include "recording/recorded_incident.hpp"

#include <nlohmann/json.hpp>

namespace clew::bridge {

using nlohmann::ordered_json;

std::string to_json(const domain::Incident& incident) {
  const ordered_json json = {
      {"kind", incident.kind}, {"stage", incident.stage}, {"text", incident.text}};
  return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

std::optional<domain::Incident> incident_from_json(std::uint64_t tick, std::string_view json) {
  const auto object = ordered_json::parse(json.begin(), json.end(), nullptr, false);
  if (!object.is_object()) return std::nullopt;
  domain::Incident incident;
  incident.tick = tick;
  for (auto& [key, field] : {std::pair<const char*, std::string&>{"kind", incident.kind},
                             {"stage", incident.stage},
                             {"text", incident.text}}) {
    const auto found = object.find(key);
    if (found == object.end() || !found->is_string()) return std::nullopt;
    field = domain::as_one_line(found->get<std::string>());
  }
  return incident;
}

}  // namespace clew::bridge

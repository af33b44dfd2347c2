// SPDX-License-Identifier: Apache-2.0
#include "supervisor/incident_log.hpp"

namespace clew::bridge {

std::optional<domain::Incident> IncidentLog::note(domain::Incident incident) {
  incident.text = domain::as_one_line(std::move(incident.text));
  Kind& kind = kinds_[incident.kind];
  const bool is_new = kind.told.count({incident.stage, incident.text}) == 0;
  if (is_new && kind.told.size() < kMostTold) {
    kind.told.emplace(incident.stage, incident.text);
    return incident;
  }
  ++kind.left_out;
  return std::nullopt;
}

std::vector<domain::Incident> IncidentLog::take_left_out() {
  std::vector<domain::Incident> all;
  for (auto& [name, kind] : kinds_) {
    const std::uint64_t count = std::exchange(kind.left_out, 0);
    if (count == 0) continue;
    all.push_back({0, name, "run",
                   std::to_string(count) + " more of this kind, the same again or beyond the " +
                       std::to_string(kMostTold) + " that are told"});
  }
  return all;
}

}  // namespace clew::bridge

// SPDX-License-Identifier: Apache-2.0
/// How incidents stand in a recording: each is a message of a channel of its own, at the time of
/// its tick.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "domain/incident.hpp"

namespace clew::bridge {

inline constexpr const char* kIncidentChannel = "clew/incidents";

/// The message: a JSON object of `kind`, `stage` and `text`.
std::string to_json(const domain::Incident& incident);
/// None if it is no such message.
std::optional<domain::Incident> incident_from_json(std::uint64_t tick, std::string_view json);

}  // namespace clew::bridge

// SPDX-License-Identifier: Apache-2.0
/// How interventions stand in a recording: each is a message of a channel of its own, at the time
/// of its tick, with the files that it brought as attachments before it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "domain/intervention.hpp"

namespace clew::bridge {

inline constexpr const char* kInterventionChannel = "clew/interventions";
/// Attachments that an intervention brought: under this, its tick, a slash and the file's name.
inline constexpr std::string_view kInterventionFiles = "intervention/";

/// The message: a JSON object of `fed_from`, `changes` and `order`.
std::string to_json(const domain::Intervention& intervention);
/// None if it is no such message.
std::optional<domain::Intervention> intervention_from_json(std::uint64_t tick,
                                                           std::string_view json);

/// The same with its tick inside, for what is planned when the run begins.
std::string to_planned_json(const domain::Intervention& intervention);
std::optional<domain::Intervention> planned_from_json(std::string_view json);

}  // namespace clew::bridge

// SPDX-License-Identifier: Apache-2.0
/// The only room that knows which vendors there are: whoever is above it names one.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "core/result.hpp"
#include "dds/participant.hpp"

namespace clew::bridge {

enum class Vendor : std::uint8_t { kCycloneDds, kFastDds };

/// `cyclonedds` or `fastdds`, as in graph files and on the command line.
std::string_view vendor_name(Vendor vendor);
std::optional<Vendor> vendor_from_name(std::string_view name);

/// Creates a participant of `vendor`. `discovery` must outlive it. An endpoint that is created
/// before its participant and that of the other endpoint know each other may match a second later.
core::Result<std::unique_ptr<Participant>> create_unsettled_participant(
    Vendor vendor, const ParticipantConfig& config, DiscoveryListener& discovery);

/// The same, and then waits a tenth of a second, in which participants get to know each other: for
/// who does not know whom to wait for.
core::Result<std::unique_ptr<Participant>> create_participant(Vendor vendor,
                                                              const ParticipantConfig& config,
                                                              DiscoveryListener& discovery);

}  // namespace clew::bridge

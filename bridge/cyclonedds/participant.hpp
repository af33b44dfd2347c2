// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "dds/participant.hpp"

namespace clew::bridge {

/// A participant of Cyclone DDS; see create_participant.
core::Result<std::unique_ptr<Participant>> create_cyclonedds_participant(
    const ParticipantConfig& config, DiscoveryListener& discovery);

}  // namespace clew::bridge

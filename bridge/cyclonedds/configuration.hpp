// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "dds/participant.hpp"

namespace clew::bridge {

/// Cyclone DDS's own configuration for a participant that speaks on 127.0.0.1 only: one line of
/// XML, also fit for the environment variable CYCLONEDDS_URI of a component that does not link
/// clew.
std::string cyclonedds_configuration(const ParticipantConfig& config);

}  // namespace clew::bridge

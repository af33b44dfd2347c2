// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "dds/participant.hpp"

namespace clew::bridge {

/// Fast DDS's own profiles for a program that does not link clew and takes the defaults: its
/// participants speak on 127.0.0.1 only, its endpoints match those of a run. A file of XML, as the
/// environment variable FASTRTPS_DEFAULT_PROFILES_FILE names one.
std::string fastdds_profiles(const ParticipantConfig& config);

}  // namespace clew::bridge

// SPDX-License-Identifier: Apache-2.0
#include "cyclonedds/participant.hpp"
#include "dds/vendor_module.hpp"

void clew_create_participant(
    const clew::bridge::ParticipantConfig& config, clew::bridge::DiscoveryListener& discovery,
    clew::core::Result<std::unique_ptr<clew::bridge::Participant>>& created) {
  created = clew::bridge::create_cyclonedds_participant(config, discovery);
}

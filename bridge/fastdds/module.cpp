// SPDX-License-Identifier: Apache-2.0
#include "dds/vendor_module.hpp"
#include "fastdds/participant.hpp"

void clew_create_participant(
    const clew::bridge::ParticipantConfig& config, clew::bridge::DiscoveryListener& discovery,
    clew::core::Result<std::unique_ptr<clew::bridge::Participant>>& created) {
  created = clew::bridge::create_fastdds_participant(config, discovery);
}

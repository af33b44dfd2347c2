// SPDX-License-Identifier: Apache-2.0
#include "dds/participant.hpp"

#include <thread>

#include "cyclonedds/participant.hpp"
#include "dds/loopback.hpp"
#include "fastdds/participant.hpp"

namespace clew::bridge {

std::string_view vendor_name(Vendor vendor) {
  return vendor == Vendor::kCycloneDds ? "cyclonedds" : "fastdds";
}

std::optional<Vendor> vendor_from_name(std::string_view name) {
  for (const Vendor vendor : {Vendor::kCycloneDds, Vendor::kFastDds}) {
    if (vendor_name(vendor) == name) return vendor;
  }
  return std::nullopt;
}

core::Result<std::unique_ptr<Participant>> create_participant(Vendor vendor,
                                                              const ParticipantConfig& config,
                                                              DiscoveryListener& discovery) {
  if (config.domain < 0 || config.domain > kMaxDomain) {
    return core::Error{
        "domain " + std::to_string(config.domain) + "; allowed: 0 to " + std::to_string(kMaxDomain),
        {}};
  }
  auto participant = vendor == Vendor::kCycloneDds
                         ? create_cyclonedds_participant(config, discovery)
                         : create_fastdds_participant(config, discovery);
  if (participant.ok()) std::this_thread::sleep_for(kSettlingTime);
  return participant;
}

}  // namespace clew::bridge

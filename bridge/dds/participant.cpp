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

core::Result<void> check_domain(int domain) {
  if (domain >= 0 && domain <= kMaxDomain) return {};
  return core::Error{
      "domain " + std::to_string(domain) + "; allowed: 0 to " + std::to_string(kMaxDomain), {}};
}

core::Result<std::unique_ptr<Participant>> create_participant(Vendor vendor,
                                                              const ParticipantConfig& config,
                                                              DiscoveryListener& discovery) {
  CLEW_RETURN_IF_ERROR(check_domain(config.domain));
  auto participant = vendor == Vendor::kCycloneDds
                         ? create_cyclonedds_participant(config, discovery)
                         : create_fastdds_participant(config, discovery);
  if (participant.ok()) std::this_thread::sleep_for(kSettlingTime);
  return participant;
}

}  // namespace clew::bridge

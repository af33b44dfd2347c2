// SPDX-License-Identifier: Apache-2.0
#include "vendors/participant_factory.hpp"

#include <chrono>
#include <thread>

#include "cyclonedds/participant.hpp"
#include "dds/rtps_ports.hpp"
#include "fastdds/participant.hpp"

namespace clew::bridge {
namespace {

// How long a new participant waits before it may have endpoints. Fast DDS answers the endpoints of
// a participant that it has just met with the next of its heartbeats, a second later, unless both
// know each other by then.
constexpr std::chrono::milliseconds kSettlingTime{100};

}  // namespace

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
  CLEW_RETURN_IF_ERROR(check_domain(config.domain));
  auto participant = vendor == Vendor::kCycloneDds
                         ? create_cyclonedds_participant(config, discovery)
                         : create_fastdds_participant(config, discovery);
  if (participant.ok()) std::this_thread::sleep_for(kSettlingTime);
  return participant;
}

}  // namespace clew::bridge

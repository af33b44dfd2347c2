// SPDX-License-Identifier: Apache-2.0
#include "vendors/participant_factory.hpp"

#include <chrono>
#include <string>
#include <thread>

#include "core/shared_library.hpp"
#include "dds/rtps_ports.hpp"
#include "dds/vendor_module.hpp"

namespace clew::bridge {
namespace {

// Fast DDS answers the endpoints of a participant that it has just met with the next of its
// heartbeats, a second later, unless both know each other by then.
constexpr std::chrono::milliseconds kSettlingTime{100};

/// A library built without security passes over all that asks for it. With it, a GUID is made from
/// the certificate, and its first bit is 1 (DDS Security 1.1, table 52); else the GUID begins with
/// the number of the vendor.
bool is_secured(const Participant& participant) { return participant.guid().front() >= '8'; }

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

core::Result<std::unique_ptr<Participant>> create_unsettled_participant(
    Vendor vendor, const ParticipantConfig& config, DiscoveryListener& discovery) {
  CLEW_RETURN_IF_ERROR(check_domain(config.domain));
  const auto module =
      core::SharedLibrary::load("libclew-" + std::string(vendor_name(vendor)) + ".so");
  if (!module.ok()) return module.error();
  const auto create = module->function<CreateParticipant>(kCreateParticipant);
  if (!create.ok()) return create.error();
  core::Result<std::unique_ptr<Participant>> participant = std::unique_ptr<Participant>();
  (*create)(config, discovery, participant);
  if (config.security && participant.ok() && !is_secured(**participant)) {
    return core::Error{"participant " + config.name + ": " + std::string(vendor_name(vendor)) +
                           " was built without DDS Security",
                       {}};
  }
  return participant;
}

core::Result<std::unique_ptr<Participant>> create_participant(Vendor vendor,
                                                              const ParticipantConfig& config,
                                                              DiscoveryListener& discovery) {
  auto participant = create_unsettled_participant(vendor, config, discovery);
  if (participant.ok()) std::this_thread::sleep_for(kSettlingTime);
  return participant;
}

}  // namespace clew::bridge

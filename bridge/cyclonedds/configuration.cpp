// SPDX-License-Identifier: Apache-2.0
#include "cyclonedds/configuration.hpp"

#include <fmt/format.h>

#include <cstdint>

#include "dds/participant.hpp"
#include "dds/rtps_ports.hpp"

namespace clew::bridge {

// Why each setting:
// - ExternalDomainId is the number on the wire; participants of one process have domains of their
//   own.
// - MaxAutoParticipantIndex: by default the tenth process of a host is refused.
// - SPDPInterval: by default 30 s. Cyclone answers a new participant once, at once, and Fast DDS
//   may not listen yet; then they meet at Cyclone's next announcement.
// - GenerateKeyhash: without it Fast DDS passes over Cyclone's news that an endpoint is gone.
// - WriterLingerDuration: kLinger; by default 1 s.
// - Watermarks: a writer takes what it is given until this much is not acknowledged, and does not
//   lower the mark after a lost packet.
std::string cyclonedds_configuration(const ParticipantConfig& config) {
  constexpr char kLoopback[] =
      "<General><Interfaces><NetworkInterface name=\"lo\" multicast=\"false\"/></Interfaces>"
      "<AllowMulticast>false</AllowMulticast></General>";
  return fmt::format(
      "<CycloneDDS><Domain Id=\"any\">{}"
      "<Discovery><ExternalDomainId>{}</ExternalDomainId>"
      "<ParticipantIndex>auto</ParticipantIndex>"
      "<MaxAutoParticipantIndex>{}</MaxAutoParticipantIndex>"
      "<Peers><Peer Address=\"{}\"/></Peers>"
      "<SPDPInterval>200 ms</SPDPInterval>"
      "<LeaseDuration>{} ms</LeaseDuration></Discovery>"
      "<Internal><GenerateKeyhash>true</GenerateKeyhash>"
      "<WriterLingerDuration>{} ms</WriterLingerDuration>"
      "<Watermarks><WhcHigh>1 MiB</WhcHigh><WhcHighInit>1 MiB</WhcHighInit>"
      "<WhcAdaptive>false</WhcAdaptive></Watermarks></Internal>"
      "</Domain></CycloneDDS>",
      config.on_network ? "" : kLoopback, config.domain, kMaxParticipantIndex, kLoopbackAddress,
      static_cast<std::int64_t>(config.lease_s * 1e3), kLinger.count());
}

}  // namespace clew::bridge

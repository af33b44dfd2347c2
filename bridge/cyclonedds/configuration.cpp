// SPDX-License-Identifier: Apache-2.0
#include "cyclonedds/configuration.hpp"

#include <fmt/format.h>

#include "dds/loopback.hpp"

namespace clew::bridge {

// ExternalDomainId: the number on the wire; participants of one process have domains of their own.
// MaxAutoParticipantIndex: by default the tenth process of a host is refused.
// SPDPInterval: by default 30 s; it must be shorter than the lease.
// Watermarks: a writer takes what it is given until this much is not acknowledged (default 500 kB),
// and does not lower the mark after a lost packet.
std::string cyclonedds_configuration(const ParticipantConfig& config) {
  return fmt::format(
      "<CycloneDDS><Domain Id=\"any\">"
      "<General><Interfaces><NetworkInterface name=\"lo\" multicast=\"false\"/></Interfaces>"
      "<AllowMulticast>false</AllowMulticast></General>"
      "<Discovery><ExternalDomainId>{}</ExternalDomainId>"
      "<ParticipantIndex>auto</ParticipantIndex>"
      "<MaxAutoParticipantIndex>{}</MaxAutoParticipantIndex>"
      "<Peers><Peer Address=\"{}\"/></Peers>"
      "<SPDPInterval>1 s</SPDPInterval>"
      "<LeaseDuration>{} ms</LeaseDuration></Discovery>"
      "<Internal><Watermarks><WhcHigh>4 MiB</WhcHigh><WhcHighInit>4 MiB</WhcHighInit>"
      "<WhcAdaptive>false</WhcAdaptive></Watermarks></Internal>"
      "</Domain></CycloneDDS>",
      config.domain, kMaxParticipantIndex, kLoopbackAddress,
      static_cast<long long>(config.lease_s * 1e3));
}

}  // namespace clew::bridge

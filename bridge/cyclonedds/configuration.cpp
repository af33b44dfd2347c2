// SPDX-License-Identifier: Apache-2.0
#include "cyclonedds/configuration.hpp"

#include <fmt/format.h>

#include <cstdint>

#include "dds/participant.hpp"
#include "dds/rtps_ports.hpp"

namespace clew::bridge {

namespace {

/// One of Cyclone DDS's three parts of security, with the plug-in that Debian's package brings.
std::string plug_in(const std::string& element, const std::string& library,
                    const std::string& functions, const std::string& settings) {
  return fmt::format(
      "<{0}><Library path=\"{1}\" initFunction=\"init_{2}\" finalizeFunction=\"finalize_{2}\"/>{3}"
      "</{0}>",
      element, library, functions, settings);
}

std::string security_settings(const SecurityFiles& files) {
  return "<Security>" +
         plug_in("Authentication", "dds_security_auth", "authentication",
                 fmt::format("<IdentityCA>file:{}</IdentityCA>"
                             "<IdentityCertificate>file:{}</IdentityCertificate>"
                             "<PrivateKey>file:{}</PrivateKey>",
                             files.authority, files.certificate, files.private_key)) +
         plug_in("Cryptographic", "dds_security_crypto", "crypto", "") +
         plug_in("AccessControl", "dds_security_ac", "access_control",
                 fmt::format("<PermissionsCA>file:{}</PermissionsCA>"
                             "<Governance>file:{}</Governance>"
                             "<Permissions>file:{}</Permissions>",
                             files.authority, files.governance, files.permissions)) +
         "</Security>";
}

/// What it speaks on; without multicast unless it speaks on every network.
std::string general_settings(const ParticipantConfig& config) {
  if (config.on_network) return "";
  const std::string interface =
      config.hosts ? fmt::format("address=\"{}\"", config.hosts->own) : "name=\"lo\"";
  return fmt::format(
      "<General><Interfaces><NetworkInterface {} multicast=\"false\"/></Interfaces>"
      "<AllowMulticast>false</AllowMulticast></General>",
      interface);
}

std::string peer_settings(const ParticipantConfig& config) {
  if (!config.hosts) return fmt::format("<Peer Address=\"{}\"/>", kLoopbackAddress);
  std::string peers;
  for (const std::string& address : config.hosts->peers) {
    peers += fmt::format("<Peer Address=\"{}\"/>", address);
  }
  return peers;
}

}  // namespace

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
  return fmt::format(
      "<CycloneDDS><Domain Id=\"any\">{}"
      "<Discovery><ExternalDomainId>{}</ExternalDomainId>"
      "<ParticipantIndex>auto</ParticipantIndex>"
      "<MaxAutoParticipantIndex>{}</MaxAutoParticipantIndex>"
      "<Peers>{}</Peers>"
      "<SPDPInterval>200 ms</SPDPInterval>"
      "<LeaseDuration>{} ms</LeaseDuration></Discovery>"
      "<Internal><GenerateKeyhash>true</GenerateKeyhash>"
      "<WriterLingerDuration>{} ms</WriterLingerDuration>"
      "<Watermarks><WhcHigh>1 MiB</WhcHigh><WhcHighInit>1 MiB</WhcHighInit>"
      "<WhcAdaptive>false</WhcAdaptive></Watermarks></Internal>{}"
      "</Domain></CycloneDDS>",
      general_settings(config), config.domain,
      config.hosts ? kMaxIndexOverHosts : kMaxParticipantIndex, peer_settings(config),
      static_cast<std::int64_t>(config.lease_s * 1e3), kLinger.count(),
      config.security ? security_settings(*config.security) : "");
}

}  // namespace clew::bridge

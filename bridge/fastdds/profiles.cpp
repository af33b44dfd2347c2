// SPDX-License-Identifier: Apache-2.0
#include "fastdds/profiles.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <vector>

#include "dds/rtps_ports.hpp"
#include "fastdds/security_properties.hpp"

namespace clew::bridge {
namespace {

std::string duration(double seconds) {
  const auto whole = static_cast<std::int64_t>(seconds);
  const auto rest = static_cast<std::int64_t>((seconds - static_cast<double>(whole)) * 1e9);
  return fmt::format("<sec>{}</sec><nanosec>{}</nanosec>", whole, rest);
}

std::string security_properties(const std::optional<SecurityFiles>& security) {
  if (!security) return {};
  std::string text = "<propertiesPolicy><properties>";
  for (const auto& [name, value] : fastdds_security_properties(*security)) {
    text += fmt::format("<property><name>{}</name><value>{}</value></property>", name, value);
  }
  return text + "</properties></propertiesPolicy>";
}

std::string locator_of(const std::string& address) {
  return fmt::format("<locator><udpv4><address>{}</address></udpv4></locator>", address);
}

std::string own_address(const ParticipantConfig& config) {
  return config.hosts ? config.hosts->own : kLoopbackAddress;
}

std::string participant_profile(const ParticipantConfig& config) {
  const std::string own = locator_of(own_address(config));
  std::string peers;
  for (const std::string& peer :
       config.hosts ? config.hosts->peers : std::vector<std::string>{kLoopbackAddress}) {
    peers += locator_of(peer);
  }
  return fmt::format(
      "<participant profile_name=\"clew\" is_default_profile=\"true\">"
      "<domainId>{}</domainId><rtps>"
      "<userTransports><transport_id>clew_loopback</transport_id></userTransports>"
      "<useBuiltinTransports>false</useBuiltinTransports>"
      "<defaultUnicastLocatorList>{}</defaultUnicastLocatorList>"
      "<builtin><discovery_config>"
      "<leaseDuration>{}</leaseDuration><leaseAnnouncement>{}</leaseAnnouncement>"
      "<initialAnnouncements><count>10</count><period>{}</period></initialAnnouncements>"
      "</discovery_config>"
      "<metatrafficUnicastLocatorList>{}</metatrafficUnicastLocatorList>"
      "<initialPeersList>{}</initialPeersList></builtin>{}"
      "</rtps></participant>",
      config.domain, own, duration(config.lease_s), duration(0.4), duration(0.02), own, peers,
      security_properties(config.security));
}

/// `tag` is data_writer or data_reader; `times` what only one of them has.
std::string endpoint_profile(const std::string& tag, const std::string& times) {
  return fmt::format(
      "<{0} profile_name=\"clew_{0}\" is_default_profile=\"true\"><qos>"
      "<reliability><kind>RELIABLE</kind></reliability>"
      "<durability><kind>TRANSIENT_LOCAL</kind></durability>"
      "<data_sharing><kind>OFF</kind></data_sharing></qos>"
      "<topic><historyQos><kind>KEEP_LAST</kind><depth>512</depth></historyQos></topic>"
      "<historyMemoryPolicy>PREALLOCATED_WITH_REALLOC</historyMemoryPolicy>{1}</{0}>",
      tag, times);
}

}  // namespace

// The reasons are those of fastdds/qos.cpp. A peer without a port is looked for at the ports of so
// many participants as maxInitialPeersRange says, of whatever domain.
std::string fastdds_profiles(const ParticipantConfig& config) {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<dds xmlns=\"http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles\"><profiles>"
      "<transport_descriptors><transport_descriptor>"
      "<transport_id>clew_loopback</transport_id><type>UDPv4</type>"
      "<interfaceWhiteList><address>{}</address></interfaceWhiteList>"
      "<maxInitialPeersRange>{}</maxInitialPeersRange>"
      "</transport_descriptor></transport_descriptors>{}{}{}</profiles></dds>\n",
      own_address(config), (config.hosts ? kMaxIndexOverHosts : kMaxParticipantIndex) + 1,
      participant_profile(config),
      endpoint_profile("data_writer", fmt::format("<times><heartbeatPeriod>{}</heartbeatPeriod>"
                                                  "</times>",
                                                  duration(0.02))),
      endpoint_profile("data_reader", ""));
}

}  // namespace clew::bridge

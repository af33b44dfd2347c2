// SPDX-License-Identifier: Apache-2.0
#include "fastdds/qos.hpp"

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <fastrtps/xmlparser/XMLProfileManager.h>
#include <unistd.h>

#include <cstdlib>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/log/Log.hpp>
#include <fastdds/dds/log/StdoutErrConsumer.hpp>
#include <memory>
#include <mutex>

#include "dds/remote_endpoints.hpp"
#include "dds/rtps_ports.hpp"
#include "fastdds/security_properties.hpp"

namespace clew::bridge {

using namespace eprosima::fastdds::dds;  // NOLINT(google-build-using-namespace): two dozen names
using eprosima::fastrtps::Duration_t;
using eprosima::fastrtps::rtps::IPLocator;
using eprosima::fastrtps::rtps::Locator_t;

namespace {

const Duration_t kHeartbeatPeriod(0.02L);

Locator_t locator_of(const std::string& address, std::uint32_t port) {
  Locator_t locator;
  locator.kind = LOCATOR_KIND_UDPv4;
  IPLocator::setIPv4(locator, address);
  locator.port = port;
  return locator;
}

/// Port 0: the one that belongs to the participant's index. Naming locators keeps multicast out.
void confine(WireProtocolConfigQos& wire, const NetworkAddresses& hosts, int last_index,
             int domain) {
  wire.builtin.metatrafficUnicastLocatorList.push_back(locator_of(hosts.own, 0));
  wire.default_unicast_locator_list.push_back(locator_of(hosts.own, 0));
  for (const std::string& peer : hosts.peers) {
    for (int index = 0; index <= last_index; ++index) {
      wire.builtin.initialPeersList.push_back(locator_of(peer, discovery_port(domain, index)));
    }
  }
}

template <typename Qos>
void set_common(Qos& qos, const EndpointSpec& spec) {
  qos.reliability().kind =
      spec.qos.reliable ? RELIABLE_RELIABILITY_QOS : BEST_EFFORT_RELIABILITY_QOS;
  qos.reliability().max_blocking_time = Duration_t(0, 0);
  qos.durability().kind =
      spec.qos.transient_local ? TRANSIENT_LOCAL_DURABILITY_QOS : VOLATILE_DURABILITY_QOS;
  qos.history().kind = spec.qos.keep_last ? KEEP_LAST_HISTORY_QOS : KEEP_ALL_HISTORY_QOS;
  qos.history().depth = spec.history_depth;
  qos.resource_limits().max_instances = 1;
  qos.endpoint().history_memory_policy =
      eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  qos.data_sharing().off();
  qos.user_data().data_vec(
      std::vector<eprosima::fastrtps::rtps::octet>(spec.user_data.begin(), spec.user_data.end()));
}

}  // namespace

void prepare_fastdds_process() {
  static std::once_flag once;
  std::call_once(once, [] {
    // Participants would turn into clients of that server.
    unsetenv("ROS_DISCOVERY_SERVER");
    Log::ClearConsumers();
    Log::RegisterConsumer(std::make_unique<StdoutErrConsumer>());
    // Profiles are read now, so that they cannot come after the next setting; participants and
    // endpoints are created with explicit QoS and take nothing from them.
    DomainParticipantFactory::get_instance()->load_profiles();
    eprosima::fastrtps::LibrarySettingsAttributes settings;
    settings.intraprocess_delivery = eprosima::fastrtps::INTRAPROCESS_OFF;
    eprosima::fastrtps::xmlparser::XMLProfileManager::library_settings(settings);
  });
}

DomainParticipantQos fastdds_participant_qos(const ParticipantConfig& config) {
  DomainParticipantQos qos;
  qos.name(config.name);
  qos.user_data().data_vec(std::vector<eprosima::fastrtps::rtps::octet>(config.user_data.begin(),
                                                                        config.user_data.end()));
  // No shared memory: its segments outlive a kill. Only the loopback interface, unless others are
  // wanted.
  auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  const NetworkAddresses hosts =
      config.hosts.value_or(NetworkAddresses{kLoopbackAddress, {kLoopbackAddress}});
  if (!config.on_network) udp->interfaceWhiteList.emplace_back(hosts.own);
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(udp);
  auto& wire = qos.wire_protocol();
  if (!config.on_network) {
    confine(wire, hosts, config.hosts ? kMaxIndexOverHosts : kMaxParticipantIndex, config.domain);
  }
  auto& discovery = wire.builtin.discovery_config;
  discovery.leaseDuration = Duration_t(static_cast<long double>(config.lease_s));
  discovery.leaseDuration_announcementperiod = Duration_t(0.4L);
  discovery.initial_announcements.count = 10;
  discovery.initial_announcements.period = Duration_t(0.02L);
  qos.properties().properties().emplace_back(kProcessIdProperty, std::to_string(getpid()), true);
  if (config.security) {
    for (const auto& [name, value] : fastdds_security_properties(*config.security)) {
      qos.properties().properties().emplace_back(name, value);
    }
  }
  return qos;
}

DataWriterQos fastdds_writer_qos(const EndpointSpec& spec) {
  DataWriterQos qos;
  set_common(qos, spec);
  // With KEEP_LAST, a full history drops its oldest sample, acknowledged or not. With KEEP_ALL it
  // drops an acknowledged one or refuses the new one. Late readers get what is in it either way.
  qos.resource_limits().max_samples = spec.history_depth;
  qos.resource_limits().max_samples_per_instance = spec.history_depth;
  qos.resource_limits().allocated_samples = 0;
  // Asynchronous sending is 2 to 10 times slower a tick.
  qos.publish_mode().kind = SYNCHRONOUS_PUBLISH_MODE;
  auto& reliable = qos.reliable_writer_qos();
  // By default 3 s, for which a sample written just before a match may be missing.
  reliable.times.heartbeatPeriod = kHeartbeatPeriod;
  // A full history, which ours is from tick n on, would ask for an acknowledgement with every
  // sample.
  reliable.disable_heartbeat_piggyback = true;
  // By default 0 s, with which a timer thread is woken for every sample and reader. What is lost is
  // asked for after a heartbeat anyway.
  reliable.times.nackSupressionDuration = kHeartbeatPeriod;
  qos.representation().m_value.push_back(XCDR_DATA_REPRESENTATION);
  return qos;
}

DataReaderQos fastdds_reader_qos(const EndpointSpec& spec) {
  DataReaderQos qos;
  set_common(qos, spec);
  // Emptied at every arrival, so this bounds nothing; by default it would stop at 5000.
  qos.resource_limits().max_samples = LENGTH_UNLIMITED;
  qos.resource_limits().max_samples_per_instance = LENGTH_UNLIMITED;
  qos.resource_limits().allocated_samples = 0;
  qos.type_consistency().representation.m_value.push_back(XCDR_DATA_REPRESENTATION);
  return qos;
}

}  // namespace clew::bridge

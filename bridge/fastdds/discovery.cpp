// SPDX-License-Identifier: Apache-2.0
#include "fastdds/discovery.hpp"

#include <fastdds/rtps/participant/ParticipantDiscoveryInfo.h>
#include <fastdds/rtps/reader/ReaderDiscoveryInfo.h>
#include <fastdds/rtps/writer/WriterDiscoveryInfo.h>

#include <cstdlib>
#include <set>
#include <utility>

#include "dds/remote_endpoints.hpp"

namespace clew::bridge {
namespace {

using eprosima::fastdds::dds::DomainParticipant;
using eprosima::fastrtps::rtps::GUID_t;
using eprosima::fastrtps::rtps::ParticipantDiscoveryInfo;
using eprosima::fastrtps::rtps::ReaderDiscoveryInfo;
using eprosima::fastrtps::rtps::WriterDiscoveryInfo;

}  // namespace

std::string fastdds_guid(const GUID_t& guid) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  const auto append = [&](eprosima::fastrtps::rtps::octet byte) {
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  };
  for (const auto byte : guid.guidPrefix.value) append(byte);
  for (const auto byte : guid.entityId.value) append(byte);
  return text;
}

void FastDiscovery::on_participant_discovery(DomainParticipant*, ParticipantDiscoveryInfo&& info) {
  Process process{info.info.m_participantName.to_string(), 0};
  for (auto it = info.info.m_properties.begin(); it != info.info.m_properties.end(); ++it) {
    if (it->first() == kProcessIdProperty) process.id = std::atoi(it->second().c_str());
  }
  std::set<std::string> names;
  {
    const std::lock_guard lock(mutex_);
    if (info.status == ParticipantDiscoveryInfo::REMOVED_PARTICIPANT ||
        info.status == ParticipantDiscoveryInfo::DROPPED_PARTICIPANT) {
      processes_.erase(info.info.m_guid.guidPrefix);
    } else {
      processes_[info.info.m_guid.guidPrefix] = std::move(process);
    }
    for (const auto& [prefix, known] : processes_) names.insert(known.name);
  }
  listener().on_participants(names);
}

void FastDiscovery::on_subscriber_discovery(DomainParticipant*, ReaderDiscoveryInfo&& info) {
  if (info.status == ReaderDiscoveryInfo::REMOVED_READER) {
    remotes_.remove(info.info.guid());
  } else {
    add_remote(info.info, false);
  }
}

void FastDiscovery::on_publisher_discovery(DomainParticipant*, WriterDiscoveryInfo&& info) {
  if (info.status == WriterDiscoveryInfo::REMOVED_WRITER) {
    remotes_.remove(info.info.guid());
  } else {
    add_remote(info.info, true);
  }
}

template <typename ProxyData>
void FastDiscovery::add_remote(const ProxyData& endpoint, bool is_writer) {
  auto remote = std::make_shared<RemoteEndpoint>();
  remote->is_writer = is_writer;
  remote->topic = endpoint.topicName().to_string();
  remote->type = endpoint.typeName().to_string();
  const auto& user_data = endpoint.m_qos.m_userData.data_vec();
  remote->user_data.assign(user_data.begin(), user_data.end());
  remote->guid = fastdds_guid(endpoint.guid());
  using namespace eprosima::fastdds::dds;  // NOLINT(google-build-using-namespace): of two kinds
  remote->reliable = endpoint.m_qos.m_reliability.kind == RELIABLE_RELIABILITY_QOS;
  remote->transient_local = endpoint.m_qos.m_durability.kind != VOLATILE_DURABILITY_QOS;
  {
    const std::lock_guard lock(mutex_);
    const auto process = processes_.find(endpoint.guid().guidPrefix);
    if (process != processes_.end()) remote->process_id = process->second.id;
  }
  remotes_.add(endpoint.guid(), remote);
}

}  // namespace clew::bridge

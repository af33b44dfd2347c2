// SPDX-License-Identifier: Apache-2.0
#include "fastdds/discovery.hpp"

#include <fastdds/rtps/participant/ParticipantDiscoveryInfo.h>
#include <fastdds/rtps/reader/ReaderDiscoveryInfo.h>
#include <fastdds/rtps/writer/WriterDiscoveryInfo.h>

#include <cstdlib>
#include <vector>

#include "dds/loopback.hpp"

namespace clew::bridge {
namespace {

using eprosima::fastdds::dds::DomainParticipant;
using eprosima::fastrtps::rtps::GUID_t;
using eprosima::fastrtps::rtps::ParticipantDiscoveryInfo;
using eprosima::fastrtps::rtps::ReaderDiscoveryInfo;
using eprosima::fastrtps::rtps::WriterDiscoveryInfo;

std::string hex(const GUID_t& guid) {
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

}  // namespace

void FastDiscovery::add_local(const std::string& topic, const std::string& type) {
  std::vector<std::shared_ptr<const RemoteEndpoint>> inconsistent;
  {
    const std::lock_guard lock(mutex_);
    local_types_.emplace(topic, type);
    for (const auto& [guid, remote] : remotes_) {
      if (remote->topic == topic && remote->type != type) inconsistent.push_back(remote);
    }
  }
  for (const auto& remote : inconsistent) listener_.on_inconsistent_type(*remote);
}

void FastDiscovery::remove_local(const std::string& topic, const std::string& type) {
  const std::lock_guard lock(mutex_);
  const auto [first, last] = local_types_.equal_range(topic);
  for (auto it = first; it != last; ++it) {
    if (it->second != type) continue;
    local_types_.erase(it);
    return;
  }
}

std::shared_ptr<const RemoteEndpoint> FastDiscovery::find(const Guid& guid) const {
  const std::lock_guard lock(mutex_);
  const auto found = remotes_.find(guid);
  return found != remotes_.end() ? found->second : nullptr;
}

void FastDiscovery::on_participant_discovery(DomainParticipant*, ParticipantDiscoveryInfo&& info) {
  int process_id = 0;
  for (auto it = info.info.m_properties.begin(); it != info.info.m_properties.end(); ++it) {
    if (it->first() == kProcessIdProperty) process_id = std::atoi(it->second().c_str());
  }
  const std::lock_guard lock(mutex_);
  if (info.status == ParticipantDiscoveryInfo::REMOVED_PARTICIPANT ||
      info.status == ParticipantDiscoveryInfo::DROPPED_PARTICIPANT) {
    process_ids_.erase(info.info.m_guid.guidPrefix);
  } else {
    process_ids_[info.info.m_guid.guidPrefix] = process_id;
  }
}

void FastDiscovery::on_subscriber_discovery(DomainParticipant*, ReaderDiscoveryInfo&& info) {
  if (info.status == ReaderDiscoveryInfo::REMOVED_READER) {
    remove_remote(info.info.guid());
  } else {
    add_remote(info.info, false);
  }
}

void FastDiscovery::on_publisher_discovery(DomainParticipant*, WriterDiscoveryInfo&& info) {
  if (info.status == WriterDiscoveryInfo::REMOVED_WRITER) {
    remove_remote(info.info.guid());
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
  remote->guid = hex(endpoint.guid());
  bool is_inconsistent = false;
  {
    const std::lock_guard lock(mutex_);
    const auto process = process_ids_.find(endpoint.guid().guidPrefix);
    if (process != process_ids_.end()) remote->process_id = process->second;
    const bool is_new = remotes_.insert_or_assign(endpoint.guid(), remote).second;
    const auto [first, last] = local_types_.equal_range(remote->topic);
    for (auto it = first; it != last; ++it) {
      if (is_new && it->second != remote->type) is_inconsistent = true;
    }
  }
  if (is_inconsistent) listener_.on_inconsistent_type(*remote);
}

void FastDiscovery::remove_remote(const Guid& guid) {
  const std::lock_guard lock(mutex_);
  remotes_.erase(guid);
}

}  // namespace clew::bridge

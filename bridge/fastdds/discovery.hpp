// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastdds/rtps/common/Guid.h>

#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "dds/participant.hpp"
#include "dds/remote_endpoints.hpp"

namespace clew::bridge {

/// A GUID as 32 hexadecimal digits.
std::string fastdds_guid(const eprosima::fastrtps::rtps::GUID_t& guid);

/// What Fast DDS tells of other participants and their endpoints. It passes over endpoints with
/// another type in silence, so types are compared here. Nothing of Fast DDS is called with the lock
/// held.
class FastDiscovery : public eprosima::fastdds::dds::DomainParticipantListener {
 public:
  using Guid = eprosima::fastrtps::rtps::GUID_t;

  explicit FastDiscovery(DiscoveryListener& listener) : remotes_(listener) {}

  /// From now on, or no longer, this participant has an endpoint on `topic` with `type`.
  void add_local(const std::string& topic, const std::string& type) {
    remotes_.add_local(topic, type);
  }
  void remove_local(const std::string& topic, const std::string& type) {
    remotes_.remove_local(topic, type);
  }

  /// The remote endpoint with this GUID; null if it is unknown.
  std::shared_ptr<const RemoteEndpoint> find(const Guid& guid) const { return remotes_.find(guid); }
  DiscoveryListener& listener() const { return remotes_.listener(); }

 private:
  void on_participant_discovery(eprosima::fastdds::dds::DomainParticipant* participant,
                                eprosima::fastrtps::rtps::ParticipantDiscoveryInfo&& info) override;
  void on_subscriber_discovery(eprosima::fastdds::dds::DomainParticipant* participant,
                               eprosima::fastrtps::rtps::ReaderDiscoveryInfo&& info) override;
  void on_publisher_discovery(eprosima::fastdds::dds::DomainParticipant* participant,
                              eprosima::fastrtps::rtps::WriterDiscoveryInfo&& info) override;
  template <typename ProxyData>
  void add_remote(const ProxyData& endpoint, bool is_writer);

  RemoteEndpoints<Guid> remotes_;
  std::mutex mutex_;
  struct Process {
    std::string name;
    int id = 0;
  };
  std::map<eprosima::fastrtps::rtps::GuidPrefix_t, Process> processes_;  ///< by participant
};

}  // namespace clew::bridge

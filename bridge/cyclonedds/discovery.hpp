// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dds/dds.h>

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "cyclonedds/entity.hpp"
#include "dds/participant.hpp"

namespace clew::bridge {

/// What Cyclone DDS tells of other participants' endpoints, and the one check that it does not
/// make: it takes two types on a topic without a word, so types are compared here.
class CycloneDiscovery {
 public:
  CycloneDiscovery(dds_entity_t participant, DiscoveryListener& listener);

  /// Starts to listen.
  core::Result<void> start();

  /// From now on, or no longer, this participant has an endpoint on `topic` with `type`.
  void add_local(const std::string& topic, const std::string& type);
  void remove_local(const std::string& topic, const std::string& type);

  /// Null if the endpoint is one of this participant.
  std::shared_ptr<const RemoteEndpoint> describe(const dds_builtintopic_endpoint_t& endpoint,
                                                 bool is_writer) const;
  DiscoveryListener& listener() const { return listener_; }

 private:
  template <bool is_writer>
  static void on_endpoints(dds_entity_t reader, void* self);
  void take_endpoints(dds_entity_t reader, bool is_writer);
  void add_remote(dds_instance_handle_t handle,
                  const std::shared_ptr<const RemoteEndpoint>& remote);
  int process_id(dds_instance_handle_t participant) const;

  dds_entity_t participant_;
  dds_guid_t participant_guid_{};
  DiscoveryListener& listener_;
  std::mutex mutex_;
  std::multimap<std::string, std::string> local_types_;  ///< by topic
  std::map<dds_instance_handle_t, std::shared_ptr<const RemoteEndpoint>> remotes_;
  CycloneEntity participants_reader_;
  CycloneEntity writers_reader_;  ///< last, since their listeners use all the rest
  CycloneEntity readers_reader_;
};

}  // namespace clew::bridge

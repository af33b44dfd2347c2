// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dds/dds.h>

#include <memory>
#include <string>

#include "cyclonedds/entity.hpp"
#include "dds/participant.hpp"
#include "dds/remote_endpoints.hpp"

namespace clew::bridge {

/// The GUID of an entity of ours, as 32 hexadecimal digits.
std::string cyclone_guid(dds_entity_t entity);

/// What Cyclone DDS tells of other participants' endpoints, and the one check that it does not
/// make: it takes two types on a topic without a word, so types are compared here.
class CycloneDiscovery {
 public:
  CycloneDiscovery(dds_entity_t participant, DiscoveryListener& listener);

  /// Starts to listen.
  core::Result<void> start();

  /// From now on, or no longer, this participant has an endpoint on `topic` with `type`.
  void add_local(const std::string& topic, const std::string& type) {
    remotes_.add_local(topic, type);
  }
  void remove_local(const std::string& topic, const std::string& type) {
    remotes_.remove_local(topic, type);
  }

  /// Null if the endpoint is one of this participant.
  std::shared_ptr<const RemoteEndpoint> describe(const dds_builtintopic_endpoint_t& endpoint,
                                                 bool is_writer) const;
  DiscoveryListener& listener() const { return remotes_.listener(); }

 private:
  static void on_participants(dds_entity_t reader, void* self);
  void report_participants(dds_entity_t reader) const;
  template <bool is_writer>
  static void on_endpoints(dds_entity_t reader, void* self);
  void take_endpoints(dds_entity_t reader, bool is_writer);
  int process_id(dds_instance_handle_t participant) const;

  dds_entity_t participant_;
  dds_guid_t participant_guid_{};
  RemoteEndpoints<dds_instance_handle_t> remotes_;
  CycloneEntity participants_reader_;
  CycloneEntity writers_reader_;  ///< last, since their listeners use all the rest
  CycloneEntity readers_reader_;
};

}  // namespace clew::bridge

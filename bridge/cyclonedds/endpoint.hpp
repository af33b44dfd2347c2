// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dds/dds.h>

#include <map>
#include <memory>
#include <mutex>

#include "cyclonedds/discovery.hpp"
#include "cyclonedds/entity.hpp"
#include "cyclonedds/raw_type.hpp"
#include "dds/participant.hpp"

namespace clew::bridge {

/// What a writer and a reader of Cyclone DDS share: a topic with a raw type, and who matches.
class CycloneEndpoint {
 public:
  CycloneEndpoint(CycloneDiscovery& discovery, EndpointSpec spec, bool is_writer);
  ~CycloneEndpoint();
  CycloneEndpoint(const CycloneEndpoint&) = delete;
  CycloneEndpoint& operator=(const CycloneEndpoint&) = delete;

  core::Result<void> create_topic(dds_entity_t participant);
  /// The QoS that writers and readers have in common.
  CycloneQos qos() const;
  /// Takes over the new writer or reader, sets `listener`, to which the calls for matches and QoS
  /// are added, and catches up with what happened before.
  core::Result<void> attach(dds_entity_t created, dds_listener_t* listener);
  /// Deletes the writer or reader; no listener of it runs any more after that.
  void detach();

  dds_entity_t handle() const { return entity_.handle(); }
  dds_entity_t topic() const { return topic_.handle(); }
  const ddsi_sertype* type() const { return type_; }
  const EndpointSpec& spec() const { return spec_; }

  /// The matched endpoint with this handle; null if it is unknown.
  std::shared_ptr<const RemoteEndpoint> find(dds_instance_handle_t handle);

 private:
  static void on_writer_matched(dds_entity_t, dds_publication_matched_status_t, void* self);
  static void on_reader_matched(dds_entity_t, dds_subscription_matched_status_t, void* self);
  static void on_writer_incompatible(dds_entity_t, dds_offered_incompatible_qos_status_t status,
                                     void* self);
  static void on_reader_incompatible(dds_entity_t, dds_requested_incompatible_qos_status_t status,
                                     void* self);
  void compare_matches();
  std::vector<dds_instance_handle_t> matched_handles() const;
  std::shared_ptr<const RemoteEndpoint> describe(dds_instance_handle_t handle) const;
  void report_incompatible(std::uint32_t policy_id);
  void report_earlier_incompatible();

  CycloneDiscovery& discovery_;
  const EndpointSpec spec_;
  const bool is_writer_;
  CycloneEntity topic_;
  const ddsi_sertype* type_ = nullptr;  ///< owned by the topic
  CycloneEntity entity_;
  std::mutex mutex_;  ///< held while matches are reported, so that reports keep their order
  std::map<dds_instance_handle_t, std::shared_ptr<const RemoteEndpoint>> matches_;
};

}  // namespace clew::bridge

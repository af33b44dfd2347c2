// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/result.hpp"
#include "dds/origin.hpp"
#include "dds/participant.hpp"
#include "ros2/environment.hpp"
#include "ros2/topic_output.hpp"
#include "vendors/participant_factory.hpp"

namespace clew::ros2 {

using bridge::Origin;

struct NodeConfig {
  bridge::Vendor vendor = bridge::Vendor::kCycloneDds;
  RosNetwork network;
  Distro distro = Distro::kJazzy;
  std::string name = "clew";
  std::string node_namespace = "/";
  Origin origin;
};

/// A node of ROS 2 as the others of its domain see one: its participant, topics with their names
/// and types as rmw_cyclonedds and rmw_fastrtps have them, and its entry in `ros_discovery_info`.
class Node : public TopicOutput, private bridge::DiscoveryListener {
 public:
  static core::Result<std::unique_ptr<Node>> create(const NodeConfig& config);

  core::Result<std::unique_ptr<bridge::SampleWriter>> open_topic(
      const std::string& topic, const MessageType& type, const QosProfile& profile) override;
  /// `listener` gets the samples as they come, from any writer.
  template <typename Message>
  core::Result<std::unique_ptr<bridge::SampleReader>> create_reader(
      const std::string& topic, const QosProfile& profile, bridge::SampleListener& listener) {
    auto reader =
        participant_->create_reader(spec(topic, message_type<Message>(), profile), listener);
    if (reader.ok()) reader_guids_.push_back((*reader)->guid());
    return reader;
  }

  /// Whether samples of this writer may come in.
  bool may_take(const bridge::RemoteEndpoint& writer) const {
    return config_.origin.may_take(writer.user_data);
  }
  /// Tells the others which topics the node has; to be called when all are there.
  core::Result<void> announce();

  /// Whether somebody reads `topic`, a whole name, of those that the node writes.
  bool is_read(const std::string& topic) const;
  /// Whether an endpoint of somebody else still meets one of ours.
  bool is_there(const std::string& guid) const;

  const NodeConfig& config() const { return config_; }

 private:
  explicit Node(NodeConfig config) : config_(std::move(config)) {}
  bridge::EndpointSpec spec(const std::string& topic, const MessageType& type,
                            const QosProfile& profile) const;
  std::string user_data(const MessageType& type) const;
  template <std::size_t kGidBytes>
  core::Result<void> announce_entities();
  void on_participants(const std::set<std::string>&) override {}
  void on_matched(const bridge::RemoteEndpoint& remote) override;
  void on_unmatched(const bridge::RemoteEndpoint& remote) override;
  void on_incompatible_qos(const std::string& topic, bool local_is_writer,
                           const std::string& policy) override;
  void on_inconsistent_type(const bridge::RemoteEndpoint& remote) override;

  NodeConfig config_;
  std::vector<std::string> writer_guids_;
  std::vector<std::string> reader_guids_;
  mutable std::mutex mutex_;                               ///< of what follows
  std::map<std::string, bridge::RemoteEndpoint> matched_;  ///< endpoints of others, by GUID
  std::unique_ptr<bridge::Participant> participant_;
  std::unique_ptr<bridge::SampleWriter> discovery_;  ///< closed before the participant
};

}  // namespace clew::ros2

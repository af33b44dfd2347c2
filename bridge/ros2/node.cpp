// SPDX-License-Identifier: Apache-2.0
#include "ros2/node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "log/log.hpp"
#include "ros2/names.hpp"

namespace clew::ros2 {
namespace {

/// As rmw_cyclonedds has it; a bridge that is killed is gone after that.
constexpr double kRosLease_s = 10.0;
/// The topic in which nodes tell what is theirs, which alone has no prefix.
constexpr char kDiscoveryTopic[] = "ros_discovery_info";

template <std::size_t kBytes>
Gid<kBytes> gid_of(const std::string& guid) {
  Gid<kBytes> gid;
  for (std::size_t i = 0; 2 * i + 1 < guid.size() && i < kBytes; ++i) {
    std::from_chars(guid.data() + 2 * i, guid.data() + 2 * i + 2, gid.data[i], 16);
  }
  return gid;
}

}  // namespace

core::Result<std::unique_ptr<Node>> Node::create(const NodeConfig& config) {
  std::unique_ptr<Node> self(new Node(config));
  bridge::ParticipantConfig participant{config.network.domain, "/", kRosLease_s};
  participant.user_data = "enclave=/;";
  participant.on_network = config.network.on_network;
  auto created = bridge::create_participant(config.vendor, participant, *self);
  if (!created.ok()) return created.error();
  self->participant_ = std::move(created).value();
  return self;
}

std::string Node::user_data(const MessageType& type) const {
  const std::string hash = config_.distro == Distro::kJazzy ? "typehash=" + type.hash + ';' : "";
  return hash + config_.origin.to_text();
}

bridge::EndpointSpec Node::spec(const std::string& topic, const MessageType& type,
                                const QosProfile& profile) const {
  return {dds_topic(topic), type.dds_name, user_data(type), profile.depth, profile.qos()};
}

core::Result<std::unique_ptr<bridge::SampleWriter>> Node::open_topic(const std::string& topic,
                                                                     const MessageType& type,
                                                                     const QosProfile& profile) {
  auto writer = participant_->create_writer(spec(topic, type, profile));
  if (writer.ok()) writer_guids_.push_back((*writer)->guid());
  return writer;
}

template <std::size_t kGidBytes>
core::Result<void> Node::announce_entities() {
  using Entities = ParticipantEntitiesInfo<kGidBytes>;
  const MessageType& type = message_type<Entities>();
  bridge::EndpointSpec endpoint = spec("", type, kLatchedProfile);
  endpoint.topic = kDiscoveryTopic;
  if (discovery_ == nullptr) {
    auto writer = participant_->create_writer(endpoint);
    if (!writer.ok()) return writer.error();
    discovery_ = std::move(writer).value();
  }
  Entities entities;
  entities.gid = gid_of<kGidBytes>(participant_->guid());
  NodeEntitiesInfo<kGidBytes>& node = entities.node_entities_info_seq.emplace_back();
  node.node_namespace = config_.node_namespace;
  node.node_name = config_.name;
  for (const std::string& guid : reader_guids_) {
    node.reader_gid_seq.push_back(gid_of<kGidBytes>(guid));
  }
  for (const std::string& guid : writer_guids_) {
    node.writer_gid_seq.push_back(gid_of<kGidBytes>(guid));
  }
  std::vector<char> buffer;
  if (discovery_->write(encode(entities, buffer)) == bridge::WriteStatus::kTaken) return {};
  return core::Error{"writing ros_discovery_info failed"};
}

core::Result<void> Node::announce() {
  return config_.distro == Distro::kJazzy ? announce_entities<16>() : announce_entities<24>();
}

bool Node::is_read(const std::string& topic) const {
  const std::string name = dds_topic(topic);
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::any_of(matched_.begin(), matched_.end(), [&](const auto& entry) {
    return !entry.second.is_writer && entry.second.topic == name;
  });
}

bool Node::is_there(const std::string& guid) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return matched_.count(guid) > 0;
}

void Node::on_matched(const bridge::RemoteEndpoint& remote) {
  const std::lock_guard<std::mutex> lock(mutex_);
  matched_[remote.guid] = remote;
}

void Node::on_unmatched(const bridge::RemoteEndpoint& remote) {
  const std::lock_guard<std::mutex> lock(mutex_);
  matched_.erase(remote.guid);
}

void Node::on_incompatible_qos(const std::string& topic, bool local_is_writer,
                               const std::string& policy) {
  logs::warning("ROS 2: a {} of {} does not match: incompatible QoS policy {}",
                local_is_writer ? "reader" : "writer", topic, policy);
}

void Node::on_inconsistent_type(const bridge::RemoteEndpoint& remote) {
  logs::warning("ROS 2: a {} of {} uses type {}", remote.is_writer ? "writer" : "reader",
                remote.topic, remote.type);
}

}  // namespace clew::ros2

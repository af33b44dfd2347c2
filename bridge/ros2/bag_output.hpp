// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "recording/mcap_writer.hpp"
#include "ros2/topic_output.hpp"

namespace clew::ros2 {

/// A bag as rosbag2 of ROS 2 Jazzy writes one: a directory with an MCAP file of profile `ros2` and
/// a `metadata.yaml` of version 9.
class BagOutput : public TopicOutput {
 public:
  /// Creates the directory. Refused: one that exists, unless `force`, which replaces the bag in it.
  static core::Result<std::unique_ptr<BagOutput>> create(const std::string& directory, bool force);

  core::Result<std::unique_ptr<bridge::SampleWriter>> open_topic(
      const std::string& topic, const MessageType& type, const QosProfile& profile) override;

  /// When what is written from now on was recorded, as nanoseconds of simulated time; never back.
  void set_time(std::uint64_t time_ns) { time_ns_ = std::max(time_ns, time_ns_); }
  /// Writes what is left, and the metadata. Also the first error of a write before.
  core::Result<void> finish();

  std::uint64_t message_count() const { return message_count_; }

 private:
  class TopicWriter;
  struct BagTopic {
    std::string name;
    std::string type;
    std::string hash;
    QosProfile profile;
    std::uint16_t channel = 0;
    std::uint64_t message_count = 0;
  };

  BagOutput(std::string directory, std::string file, bridge::mcap::McapWriter writer);
  bridge::WriteStatus write(std::size_t topic, std::string_view cdr);
  std::string metadata_yaml() const;

  std::string directory_;
  std::string file_;  ///< within the directory
  bridge::mcap::McapWriter writer_;
  std::vector<BagTopic> topics_;
  std::uint64_t time_ns_ = 0;
  std::uint64_t first_ns_ = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t message_count_ = 0;
  core::Result<void> state_;
};

}  // namespace clew::ros2

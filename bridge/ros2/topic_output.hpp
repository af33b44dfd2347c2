// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/result.hpp"
#include "dds/participant.hpp"
#include "ros2/message_codec.hpp"
#include "ros2/message_type.hpp"
#include "ros2/qos_profile.hpp"

namespace clew::ros2 {

/// Where topics are written: a node on the wire, or a bag.
class TopicOutput {
 public:
  virtual ~TopicOutput() = default;
  /// `topic` is a whole name: `/scan`. The output must outlive the writer.
  virtual core::Result<std::unique_ptr<bridge::SampleWriter>> open_topic(
      const std::string& topic, const MessageType& type, const QosProfile& profile) = 0;
};

/// Writes messages of one type to one topic. A write waits for nobody: a reader that is too slow
/// loses the oldest.
template <typename Message>
class Publisher {
 public:
  using Type = Message;

  static core::Result<Publisher> create(TopicOutput& output, const std::string& topic,
                                        const QosProfile& profile) {
    auto writer = output.open_topic(topic, message_type<Message>(), profile);
    if (!writer.ok()) return writer.error();
    return Publisher(std::move(writer).value());
  }

  void publish(const Message& message) { writer_->write(encode(message, buffer_)); }

 private:
  explicit Publisher(std::unique_ptr<bridge::SampleWriter> writer) : writer_(std::move(writer)) {}

  std::unique_ptr<bridge::SampleWriter> writer_;
  std::vector<char> buffer_;
};

}  // namespace clew::ros2

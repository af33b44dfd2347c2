// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "dds/participant.hpp"
#include "ros2/messages.hpp"
#include "ros2/node.hpp"

namespace clew::ros2 {

/// Goals that somebody of ROS publishes, as RViz does. One writer is listened to, the first that
/// says something, until it is gone: two people who steer one robot are one too many.
class GoalInput : private bridge::SampleListener {
 public:
  /// `node` must outlive it.
  explicit GoalInput(const Node& node) : node_(node) {}

  /// Opens the reader; `node` is that of the constructor, `topic` a whole name.
  core::Result<void> listen(Node& node, const std::string& topic);

  /// What has come since the last call.
  std::vector<PoseStamped> take();
  /// Who is listened to and who is not, since the last call.
  std::vector<std::string> take_notices();

 private:
  static constexpr std::size_t kMostWaiting = 16;

  void on_sample(std::string_view cdr, const bridge::RemoteEndpoint* writer) override;
  bool is_listened_to(const std::string& writer);

  const Node& node_;
  std::mutex mutex_;  ///< of what follows
  std::string writer_;
  std::string refused_;  ///< the last writer that was not listened to
  std::vector<PoseStamped> goals_;
  std::vector<std::string> notices_;
  std::unique_ptr<bridge::SampleReader> reader_;  ///< closed first
};

}  // namespace clew::ros2

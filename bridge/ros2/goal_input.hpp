// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <set>
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

  /// The newest that has come since the last call.
  std::optional<PoseStamped> take();
  /// Who is listened to and who is not, since the last call.
  std::vector<std::string> take_notices();

 private:
  /// Notices that wait, and refused writers that are remembered.
  static constexpr std::size_t kMost = 16;

  void on_sample(std::string_view cdr, const bridge::RemoteEndpoint* writer) override;
  bool is_listened_to(const std::string& writer);
  void note(std::string notice);

  const Node& node_;
  std::mutex mutex_;  ///< of what follows
  std::string writer_;
  std::set<std::string> refused_;  ///< writers that were not listened to
  std::optional<PoseStamped> goal_;
  std::vector<std::string> notices_;
  std::unique_ptr<bridge::SampleReader> reader_;  ///< closed first
};

}  // namespace clew::ros2

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

/// Goals that somebody of ROS publishes: one as RViz does, or way-points as a path. One writer is
/// listened to, the first that says something, until it is gone: two people who steer one robot are
/// one too many.
class GoalInput {
 public:
  /// `node` must outlive it.
  explicit GoalInput(const Node& node) : node_(node), pose_(*this), path_(*this) {}

  /// Opens the readers; `node` is that of the constructor, the topics are whole names.
  core::Result<void> listen(Node& node, const std::string& pose_topic,
                            const std::string& path_topic);

  /// The newest that have come since the last call, each with its frame; none: the goals are
  /// cancelled.
  std::optional<std::vector<PoseStamped>> take();
  /// Who is listened to and who is not, since the last call.
  std::vector<std::string> take_notices();

 private:
  /// Notices that wait, and refused writers that are remembered.
  static constexpr std::size_t kMost = 16;

  /// Listens to one of the two topics.
  template <typename Message>
  class Listener : public bridge::SampleListener {
   public:
    explicit Listener(GoalInput& goals) : goals_(goals) {}
    void on_sample(std::string_view cdr, const bridge::RemoteEndpoint* writer) override;

   private:
    GoalInput& goals_;
  };

  bool is_listened_to(const std::string& writer);
  void note(std::string notice);

  const Node& node_;
  std::mutex mutex_;  ///< of what follows
  std::string writer_;
  std::set<std::string> refused_;  ///< writers that were not listened to
  std::optional<std::vector<PoseStamped>> goals_;
  std::vector<std::string> notices_;
  Listener<PoseStamped> pose_;
  Listener<Path> path_;
  std::unique_ptr<bridge::SampleReader> pose_reader_;  ///< the readers are closed first
  std::unique_ptr<bridge::SampleReader> path_reader_;
};

}  // namespace clew::ros2

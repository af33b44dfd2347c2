// SPDX-License-Identifier: Apache-2.0
#include "ros2/goal_input.hpp"

#include <utility>

#include "ros2/message_codec.hpp"

namespace clew::ros2 {

core::Result<void> GoalInput::listen(Node& node, const std::string& topic) {
  auto reader = node.create_reader<PoseStamped>(topic, kDefaultProfile, *this);
  if (!reader.ok()) return reader.error();
  reader_ = std::move(reader).value();
  return {};
}

std::vector<PoseStamped> GoalInput::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(goals_, {});
}

std::vector<std::string> GoalInput::take_notices() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(notices_, {});
}

// The run's own goal comes back, too: this node publishes it.
void GoalInput::on_sample(std::string_view cdr, const bridge::RemoteEndpoint* writer) {
  if (writer == nullptr || !node_.may_take(*writer)) return;
  PoseStamped goal;
  const auto decoded = decode(cdr, goal);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!is_listened_to(writer->guid)) return;
  if (!decoded.ok()) {
    notices_.push_back(decoded.error().message);
  } else if (goals_.size() < kMostWaiting) {
    goals_.push_back(std::move(goal));
  }
}

bool GoalInput::is_listened_to(const std::string& writer) {
  if (writer == writer_) return true;
  if (writer_.empty() || !node_.is_there(writer_)) {
    writer_ = writer;
    notices_.push_back("goals are taken from the writer " + writer);
    return true;
  }
  if (refused_ != writer) notices_.push_back("a goal of another writer is refused: " + writer);
  refused_ = writer;
  return false;
}

}  // namespace clew::ros2

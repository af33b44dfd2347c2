// SPDX-License-Identifier: Apache-2.0
#include "ros2/goal_input.hpp"

#include <utility>

#include "ros2/message_codec.hpp"

namespace clew::ros2 {

namespace {

/// The prefix of a GUID: two writers of one participant are the same somebody.
std::string_view participant_of(std::string_view guid) { return guid.substr(0, 24); }

std::vector<PoseStamped> places_of(PoseStamped goal) { return {std::move(goal)}; }

/// A pose of a path that names no frame is in the path's.
std::vector<PoseStamped> places_of(Path path) {
  for (PoseStamped& place : path.poses) {
    if (place.header.frame_id.empty()) place.header.frame_id = path.header.frame_id;
  }
  return std::move(path.poses);
}

}  // namespace

core::Result<void> GoalInput::listen(Node& node, const std::string& pose_topic,
                                     const std::string& path_topic) {
  auto pose_reader = node.create_reader<PoseStamped>(pose_topic, kDefaultProfile, pose_);
  if (!pose_reader.ok()) return pose_reader.error();
  pose_reader_ = std::move(pose_reader).value();
  auto path_reader = node.create_reader<Path>(path_topic, kDefaultProfile, path_);
  if (!path_reader.ok()) return path_reader.error();
  path_reader_ = std::move(path_reader).value();
  return {};
}

std::optional<std::vector<PoseStamped>> GoalInput::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(goals_, std::nullopt);
}

std::vector<std::string> GoalInput::take_notices() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(notices_, {});
}

// The run's own goal comes back, too: this node publishes it.
template <typename Message>
void GoalInput::Listener<Message>::on_sample(std::string_view cdr,
                                             const bridge::RemoteEndpoint* writer) {
  if (writer == nullptr || !goals_.node_.may_take(*writer)) return;
  Message message;
  const auto decoded = decode(cdr, message);
  const std::lock_guard<std::mutex> lock(goals_.mutex_);
  if (!decoded.ok()) return goals_.note(decoded.error().message);
  if (goals_.is_listened_to(writer->guid)) goals_.goals_ = places_of(std::move(message));
}

// Whoever makes a GoalInput needs them.
template class GoalInput::Listener<PoseStamped>;
template class GoalInput::Listener<Path>;

void GoalInput::note(std::string notice) {
  if (notices_.size() < kMost) notices_.push_back(std::move(notice));
}

bool GoalInput::is_listened_to(const std::string& writer) {
  if (!writer_.empty() && participant_of(writer) == participant_of(writer_)) {
    writer_ = writer;
    return true;
  }
  if (writer_.empty() || !node_.is_there(writer_)) {
    writer_ = writer;
    refused_.clear();
    note("goals are taken from the writer " + writer);
    return true;
  }
  if (refused_.size() < kMost && refused_.insert(writer).second) {
    note("a goal of another writer is refused: " + writer);
  }
  return false;
}

}  // namespace clew::ros2

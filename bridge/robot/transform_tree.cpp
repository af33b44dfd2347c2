// SPDX-License-Identifier: Apache-2.0
#include "robot/transform_tree.hpp"

#include <cmath>

#include "core/math.hpp"

namespace clew::robot {
namespace {

/// A stranger's frames may go round in a circle, or be without end.
constexpr int kDeepest = 64;
constexpr std::size_t kMostFrames = 4096;
/// cos of the greatest tilt of a laser, about 11 degrees.
constexpr double kLevel = 0.98;

/// ROS 1 wrote names with a slash before them, and some still do.
std::string frame_name(const std::string& name) {
  return !name.empty() && name.front() == '/' ? name.substr(1) : name;
}

}  // namespace

void TransformTree::add(const ros2::TFMessage& message) {
  for (const ros2::TransformStamped& each : message.transforms) {
    const ros2::Vector3& t = each.transform.translation;
    const ros2::Quaternion& q = each.transform.rotation;
    const Eigen::Quaterniond rotation(q.w, q.x, q.y, q.z);
    const double length = rotation.norm();
    if (!std::isfinite(t.x + t.y + t.z) || !std::isfinite(length) || length < 0.5) continue;
    const std::string child = frame_name(each.child_frame_id);
    if (edges_.size() >= kMostFrames && edges_.count(child) == 0) continue;
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = rotation.normalized().toRotationMatrix();
    pose.translation() = Eigen::Vector3d(t.x, t.y, t.z);
    edges_[child] = {frame_name(each.header.frame_id), pose};
  }
}

Eigen::Isometry3d TransformTree::climb(std::string& frame) const {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (int i = 0; i < kDeepest; ++i) {
    const auto edge = edges_.find(frame);
    if (edge == edges_.end()) break;
    pose = edge->second.pose_parent_child * pose;
    frame = edge->second.parent;
  }
  return pose;
}

std::optional<Mount> TransformTree::mount(const std::string& base, const std::string& frame) const {
  std::string top_of_base = frame_name(base);
  std::string top_of_frame = frame_name(frame);
  if (top_of_base == top_of_frame) return Mount{};
  const Eigen::Isometry3d pose_top_base = climb(top_of_base);
  const Eigen::Isometry3d pose_top_frame = climb(top_of_frame);
  if (top_of_base != top_of_frame) return std::nullopt;
  const Eigen::Isometry3d pose = pose_top_base.inverse() * pose_top_frame;
  const double up = pose.linear()(2, 2);
  if (std::fabs(up) < kLevel) return std::nullopt;
  const Eigen::Vector3d ahead = pose.linear().col(0);
  return Mount{{pose.translation().x(), pose.translation().y(), core::atan2(ahead.y(), ahead.x())},
               up < 0.0};
}

}  // namespace clew::robot

// SPDX-License-Identifier: Apache-2.0
#include "plan/world_subgoals.hpp"

namespace clew::plan {

Subgoal WorldSubgoals::step(const Situation& situation) {
  const core::Pose2& robot = situation.odometry.pose_odom_robot;
  while (state_.next < situation.subgoals.size() &&
         core::distance_m(robot, situation.subgoals[state_.next]) <= parameters_.close_m) {
    ++state_.next;
  }
  if (state_.next >= situation.subgoals.size())
    return {situation.target, situation.target_radius_m};
  return {situation.subgoals[state_.next], parameters_.close_m};
}

void WorldSubgoals::save(core::StateWriter& writer) const { writer(state_); }

}  // namespace clew::plan

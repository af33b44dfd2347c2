// SPDX-License-Identifier: Apache-2.0
#include "recover/escapes/goal_stack.hpp"

namespace clew::recover {
namespace {

// Coming nearer by less is no progress: a robot that turns on the spot jitters.
constexpr double kNearer_m = 0.05;

}  // namespace

void GoalStack::push(const core::Vec2& position_odom, std::uint64_t tick) {
  state_.goals.push_back({position_odom, std::numeric_limits<double>::infinity(), tick});
}

void GoalStack::pop(std::uint64_t tick) {
  state_.goals.resize(state_.goals.size() - 1);
  if (empty()) return;
  Goal& top = state_.goals[state_.goals.size() - 1];
  top.least_m = std::numeric_limits<double>::infinity();
  top.progress_tick = tick;
}

GoalStack::Change GoalStack::update(const Situation& situation) {
  if (empty()) return Change::kNone;
  Goal& top = state_.goals[state_.goals.size() - 1];
  const double distance_m = core::distance_m(situation.pose(), top.position_odom);
  if (distance_m <= close_m_) {
    pop(situation.tick);
    return Change::kReached;
  }
  if (distance_m < top.least_m - kNearer_m) {
    top.least_m = distance_m;
    top.progress_tick = situation.tick;
  } else if (static_cast<double>(situation.tick - top.progress_tick) > patience_ticks_) {
    pop(situation.tick);
    return Change::kDropped;
  }
  return Change::kNone;
}

}  // namespace clew::recover

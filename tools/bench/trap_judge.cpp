// SPDX-License-Identifier: Apache-2.0
#include "bench/trap_judge.hpp"

#include <algorithm>

namespace clew::bench {
namespace {

/// A minimum on the lattice is so much off at most (world_analysis/README.md), and so must the
/// robot be nearer to the target to have left for good.
constexpr double kSurelyNearer_m = 0.1;
constexpr double kLeastCircle_m = 1.0;

}  // namespace

core::Result<void> TrapJudge::add(const bridge::SampleView& sample) {
  if (sample.topic == domain::Topic::kState) {
    CLEW_RETURN_IF_ERROR(states_.decode(sample.cdr, state_));
    add(state_);
  } else if (sample.topic == domain::Topic::kEvent) {
    CLEW_RETURN_IF_ERROR(events_.decode(sample.cdr, event_));
    add(event_);
  }
  return {};
}

void TrapJudge::add(const domain::State& state) {
  time_s_ = state.stamp.sim_time_s;
  if (traps_ == nullptr) return;
  const core::Vec2 position = state.pose_world_robot.position();
  track_.push_back({position, state.path_length_m});
  const double distance_m = core::length(position - traps_->target());
  if (held_below_m_ && distance_m < *held_below_m_ - kSurelyNearer_m) held_below_m_.reset();
  for (auto trap = traps_->trap_at(position); trap; trap = traps_->traps()[*trap].inside_of) {
    if (!held_below_m_) begin_capture(state);
    held_below_m_ = std::min(*held_below_m_, traps_->traps()[*trap].nearest_m);
  }
}

void TrapJudge::begin_capture(const domain::State& state) {
  ++captures_;
  captured_at_s_ = state.stamp.sim_time_s;
  captured_at_m_ = state.path_length_m;
  held_below_m_ = world_analysis::Trap::kNoWayOut;
  has_noticed_.assign(scores_.size(), false);
}

void TrapJudge::add(const domain::Event& event) {
  for (const domain::EventEntry& entry : event.entries) {
    if (entry.kind == domain::EventKind::kTrap) alarm(entry);
  }
}

void TrapJudge::alarm(const domain::EventEntry& entry) {
  const auto found = std::find_if(scores_.begin(), scores_.end(), [&](const DetectorScore& score) {
    return score.rule == entry.rule && score.shadow == entry.shadow;
  });
  const auto index = static_cast<std::size_t>(found - scores_.begin());
  if (found == scores_.end()) {  // a third-party component
    scores_.push_back({entry.rule, entry.shadow, 0, 0, 0, {}, {}});
    has_noticed_.push_back(false);
  }
  DetectorScore& score = scores_[index];
  ++score.alarms;
  if (traps_ == nullptr) return;
  if (!held_below_m_) {
    if (!is_in_circle()) ++score.false_alarms;
  } else if (!has_noticed_[index]) {
    has_noticed_[index] = true;
    ++score.noticed;
    score.delays_s.push_back(time_s_ - captured_at_s_);
    score.delays_m.push_back(track_.back().travel_m - captured_at_m_);
  }
}

bool TrapJudge::is_in_circle() const {
  if (track_.empty()) return false;
  const Footprint& now = track_.back();
  return std::any_of(track_.begin(), track_.end(), [&](const Footprint& then) {
    return now.travel_m - then.travel_m > kLeastCircle_m &&
           core::length(now.position - then.position) < 2.0 * robot_radius_m_;
  });
}

}  // namespace clew::bench

// SPDX-License-Identifier: Apache-2.0
#include "recover/escapes/cut_proof.hpp"

#include <cmath>
#include <utility>

namespace clew::recover {
namespace {

// How often a way is sought on the old map.
constexpr double kSeek_s = 1.0;

}  // namespace

CutProof::CutProof(double proof_s, const map::LocalPathParameters& path,
                   const domain::BehaviourSetup& setup)
    : proof_s_(proof_s),
      tick_s_(setup.tick_s),
      replan_ticks_(static_cast<std::uint64_t>(std::ceil(kSeek_s / setup.tick_s))),
      path_(path, setup.robot.radius_m, setup.tick_s) {}

/// That of before; with the first tick it takes over what was loaded.
map::LocalMap& CutProof::seen(const Situation& situation) {
  if (!seen_) {
    seen_ = *situation.local_map;
    seen_->restore(std::exchange(loaded_, {}));
  }
  return *seen_;
}

void CutProof::watch(const Situation& situation) {
  const core::Vec2 before_odom = std::exchange(state_.position_odom, situation.pose().position());
  if (!state_.cut) return;
  seen(situation).see(situation.odometry, situation.scan);
  path_.allow_passed(before_odom, state_.position_odom);
  if (situation.tick - state_.sought_tick < replan_ticks_) return;
  state_.sought_tick = situation.tick;
  path_.plan({situation.tick, state_.position_odom, situation.target_odom,
              situation.target_radius_m, *seen_});
  if (!path_.exists()) return;
  state_.cut = false;
  state_.last_look = false;
  seen_->forget();
  path_.forget_all();
}

bool CutProof::close(const Situation& situation, const map::LocalPath& path) {
  if (state_.last_look) return true;
  if (!state_.cut) {
    state_.cut = true;
    state_.since_tick = situation.tick;
    state_.sought_tick = situation.tick;
    seen(situation) = *situation.local_map;
  }
  for (const core::Vec2& place : path.refused_odom()) path_.refuse(place);
  state_.last_look = is_over(situation);
  return false;
}

bool CutProof::asks_for_last_look(const Situation& situation) {
  if (!state_.cut || state_.last_look || !is_over(situation)) return false;
  state_.last_look = true;
  return true;
}

bool CutProof::is_over(const Situation& situation) const {
  return static_cast<double>(situation.tick - state_.since_tick) * tick_s_ >= proof_s_;
}

void CutProof::save(core::StateWriter& writer) const {
  map::SeenMap::State seen = seen_ ? seen_->seen().state() : loaded_;
  writer(state_, seen);
  path_.save(writer);
}

void CutProof::load(core::StateReader& reader) {
  seen_.reset();
  reader(state_, loaded_);
  if (!reader.check(is_valid(loaded_), "a cell of the map has two marks")) loaded_ = {};
  path_.load(reader);
}

}  // namespace clew::recover

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
      path_(path, setup.robot.radius_m, setup.tick_s),
      no_room_(setup.robot.radius_m) {}

/// That of before; with the first tick it takes over what was loaded.
map::LocalMap& CutProof::seen(const Situation& situation) {
  if (!seen_) {
    seen_ = *situation.local_map;
    seen_->restore(std::exchange(loaded_, {}));
  }
  return *seen_;
}

void CutProof::watch(const Situation& situation) {
  if (!state_.cut) return;
  seen(situation).see(situation.odometry, situation.scan);
  no_room_.see(situation.odometry, situation.scan, seen_->path_cell_m());
  if (situation.tick - state_.sought_tick < replan_ticks_) return;
  state_.sought_tick = situation.tick;
  path_.plan({situation.tick, situation.pose().position(), situation.target_odom,
              situation.target_radius_m, *seen_, nullptr, &no_room_});
  if (!path_.exists()) return;
  state_.cut = false;
  state_.last_look = false;
  seen_->forget();
  no_room_.forget();
  path_.forget_all();
}

bool CutProof::close(const Situation& situation, const map::NoRoom& no_room) {
  if (state_.last_look) return true;
  if (!state_.cut) {
    state_.cut = true;
    state_.since_tick = situation.tick;
    state_.sought_tick = situation.tick;
    seen(situation) = *situation.local_map;
    no_room_ = no_room;
  }
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
  no_room_.save(writer);
}

void CutProof::load(core::StateReader& reader) {
  seen_.reset();
  reader(state_, loaded_);
  if (!reader.check(is_valid(loaded_), "a cell of the map has two marks")) loaded_ = {};
  path_.load(reader);
  no_room_.load(reader);
}

}  // namespace clew::recover

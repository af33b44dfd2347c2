// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "domain/inside.hpp"
#include "domain/setup.hpp"
#include "map/local_map.hpp"
#include "map/local_path.hpp"
#include "map/no_room.hpp"
#include "recover/situation.hpp"

namespace clew::recover {

/// Proves that a target cannot be reached: what was seen parts the robot from it, and a cut of that
/// kind stood unchanged for `proof_s` of simulated time, and was then seen once more.
///
/// From the first cut on, all that was seen is kept up in a map of its own, in which nothing is
/// forgotten but what is seen to be otherwise now; the robot meanwhile goes by what it sees afresh.
/// The proof fails as soon as that old map, too, has a way: somebody has stood in it. After
/// `proof_s` the robot looks at everything afresh for a last time, so that what closes every way
/// then was seen after all who stood around for less had gone.
///
/// Only what was seen counts: hits, and places that certainly have no room for the body (NoRoom).
/// That the robot was held somewhere is no sight of an obstacle.
class CutProof {
 public:
  struct State {
    bool cut = false;        ///< every way was closed at `since_tick`, and has been since
    bool last_look = false;  ///< all that the robot goes by was seen after proof_s
    std::uint64_t since_tick = 0;
    std::uint64_t sought_tick = 0;  ///< when a way was last sought on the old map
  };

  CutProof(double proof_s, const map::LocalPathParameters& path,
           const domain::BehaviourSetup& setup);

  /// Takes in a tick, whether anybody escapes or not.
  void watch(const Situation& situation);
  /// What the robot has seen closes every way, with what has no room for it. True if that is the
  /// proof; else it must look afresh.
  bool close(const Situation& situation, const map::NoRoom& no_room);
  /// The robot must forget what it has seen and look for the last time.
  bool asks_for_last_look(const Situation& situation);

  void tell(const Situation& situation, domain::Inside& inside) const;
  void save(core::StateWriter& writer) const;
  void load(core::StateReader& reader);

 private:
  map::LocalMap& seen(const Situation& situation);
  bool is_over(const Situation& situation) const;

  double proof_s_;
  double tick_s_;
  std::uint64_t replan_ticks_;
  map::LocalPath path_;                // on what was seen before, from the first cut on
  std::optional<map::LocalMap> seen_;  // that; made with the first tick that is taken in
  map::SeenMap::State loaded_;         // of it, until then
  map::NoRoom no_room_;                // and what was seen from near
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, CutProof::State& s) {
  visit(s.cut, s.last_look, s.since_tick, s.sought_tick);
}

}  // namespace clew::recover

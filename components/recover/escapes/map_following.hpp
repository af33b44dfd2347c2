// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <memory>

#include "core/angle.hpp"
#include "core/result.hpp"
#include "domain/setup.hpp"
#include "map/local_path.hpp"
#include "recover/escapes/cut_proof.hpp"
#include "recover/escapes/escape.hpp"

namespace clew::recover {

struct MapFollowingParameters {
  map::LocalPathParameters path;
  double patience_s = 0.0;
  double close_m = 0.3;
  double leave_rise_m = 0.0;
  double nearer_m = 0.2;
  double shorter_m = 0.05;
  double held_s = 8.0;
  double held_within_m = 0.12;
  double turn_first_rad = core::radians(30.0);
  double proof_s = 60.0;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, MapFollowingParameters& p) {
  visit_parameters(visit, p.path);
  visit.number("patience_s", p.patience_s, "s", {0.0, 1000.0},
               "the escape gives motions itself after this time without progress; 0: at once");
  visit.number("close_m", p.close_m, "m", {0.01, 10.0},
               "a virtual target is reached within this distance");
  visit.number("leave_rise_m", p.leave_rise_m, "m", {0.0, 10.0},
               "ends where the rest of the path leads away from the target by no more than this");
  visit.number("nearer_m", p.nearer_m, "m", {0.0, 10.0},
               "ends only where the robot is this much nearer to the target than at the last end");
  visit.number("shorter_m", p.shorter_m, "m", {0.001, 1.0},
               "the robot makes progress if the rest of the path becomes shorter by this");
  visit.number("held_within_m", p.held_within_m, "m", {0.01, 1.0},
               "a robot that moves less than this while it is led is held at that place");
  visit.angle("turn_first_deg", p.turn_first_rad, {1.0, 180.0},
              "greater turns are made on the spot, so that the sensors see where the step goes");
  visit.number("held_s", p.held_s, "s", {0.1, 1000.0},
               "a place is closed if the robot is held before it for this time; longer where it is "
               "slow or its ticks are long");
  visit.number("proof_s", p.proof_s, "s", {0.0, 100000.0},
               "unreachable if the map closes every path for this time");
}

/// Leads out of a trap along a path on the local map. The path is planned when a detector says
/// trap, then every `replan_s`, and at once if a new obstacle lies on it. Its corners are virtual
/// targets for the controller; if the robot makes no progress, the escape gives the motions itself.
/// The escape ends where the rest of the path hardly leads away from the target, nearer to the
/// target than at its last end. It says `unreachable` if certain obstacles separate the robot from
/// the target, and go on to for `proof_s` (CutProof).
///
/// A place that holds the robot is closed. Where such places alone close every way, nothing is
/// proved: they are open again, the robot tries once more, and from then on notes what it certainly
/// has no room in (NoRoom).
class MapFollowing : public Escape {
 public:
  using Parameters = MapFollowingParameters;

  struct State {
    double ended_at_m = std::numeric_limits<double>::infinity();  ///< from the target, at least
    double least_length_m = 0.0;                ///< of the rest of the path, so far
    core::Vec2 held_odom = core::Vec2::Zero();  ///< where the robot was led from last
    std::uint64_t held_tick = 0;                ///< since when
    std::uint64_t progress_tick = 0;            ///< when that was last undercut
    bool looks_closely = false;  ///< what holds it has closed every way once: it notes NoRoom
  };

  MapFollowing(const Parameters& parameters, const domain::BehaviourSetup& setup,
               std::unique_ptr<map::PathSearch> search);

  bool reads_local_map() const override { return true; }
  void watch(const Situation& situation) override { proof_.watch(situation); }
  void begin(const Situation& situation, const TrapEvidence& evidence) override;
  EscapeStatus step(const Situation& situation, domain::Guidance& guidance) override;
  void tell(const Situation& situation, domain::Inside& inside) const override;
  void save(core::StateWriter& writer) const override;
  void load(core::StateReader& reader) override;

 private:
  map::PathRequest path_request(const Situation& situation) const;
  bool keep_up(const Situation& situation);
  void look_closely(const Situation& situation);
  EscapeStatus look_afresh(domain::Guidance& guidance);
  void note_where_held(const Situation& situation, const core::Vec2& corner_odom);
  bool gets_on(const Situation& situation, bool planned);
  domain::Motion motion_to(const Situation& situation, const core::Vec2& place_odom) const;

  Parameters parameters_;
  double tick_s_;
  domain::MotionLimits limits_;
  std::uint64_t held_ticks_;
  map::LocalPath path_;
  map::NoRoom no_room_;
  CutProof proof_;
  State state_;
};

/// By what paths are sought.
enum class PathBy : std::uint8_t { kDistance, kNeural };

struct RememberedMapParameters {
  MapFollowingParameters following;
  PathBy search = PathBy::kDistance;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, RememberedMapParameters& p) {
  visit.choice("search", p.search, {{"distance", PathBy::kDistance}, {"neural", PathBy::kNeural}},
               "paths of least cost, repaired as more is seen; or those of the neural map of "
               "Lagoudakis & Maida 1999, made anew each time");
  visit_parameters(visit, p.following);
}

/// The escape with repaired paths of least cost, or with those of the neural map.
class RememberedMap final : public MapFollowing {
 public:
  using MapFollowing::MapFollowing;
  using Parameters = RememberedMapParameters;
  static core::Result<std::unique_ptr<RememberedMap>> create(const Parameters& parameters,
                                                             const domain::BehaviourSetup& setup);
};

/// Baseline: the same escape with replanning A*.
class RememberedAStar final : public MapFollowing {
 public:
  using MapFollowing::MapFollowing;
  static core::Result<std::unique_ptr<RememberedAStar>> create(const Parameters& parameters,
                                                               const domain::BehaviourSetup& setup);
};

template <typename Visitor>
void visit_fields(Visitor& visit, MapFollowing::State& s) {
  visit(s.ended_at_m, s.least_length_m, s.held_odom, s.held_tick, s.progress_tick, s.looks_closely);
}

}  // namespace clew::recover

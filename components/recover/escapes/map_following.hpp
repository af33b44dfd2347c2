// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <memory>

#include "core/angle.hpp"
#include "core/result.hpp"
#include "domain/setup.hpp"
#include "map/local_path.hpp"
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
  std::int64_t proofs = 2;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, MapFollowingParameters& p) {
  visit_parameters(visit, p.path);
  visit.number("patience_s", p.patience_s, "s", {0.0, 1000.0},
               "the way is followed by motions after this time without getting on; 0: at once");
  visit.number("close_m", p.close_m, "m", {0.01, 10.0}, "a virtual target this near is reached");
  visit.number("leave_rise_m", p.leave_rise_m, "m", {0.0, 10.0},
               "ends where the rest of the way leads away from the target by no more than this");
  visit.number("nearer_m", p.nearer_m, "m", {0.0, 10.0},
               "ends where the robot is this much nearer to the target than at the last end");
  visit.number("shorter_m", p.shorter_m, "m", {0.001, 1.0},
               "gets on if the way still to go becomes shorter by this");
  visit.number("held_within_m", p.held_within_m, "m", {0.01, 1.0},
               "a robot that is led and does not get farther from where it was is held there");
  visit.angle("turn_first_deg", p.turn_first_rad, {1.0, 180.0},
              "greater turns are made on the spot: the sensors must see what the step goes into");
  visit.number("held_s", p.held_s, "s", {0.1, 1000.0},
               "a place that the robot does not get to for this time is none that it can get to");
  visit.integer("proofs", p.proofs, "1", {1, 10},
                "unreachable if what was seen closes every way, this many times from the start");
}

/// A way out of a trap by all that was seen during the run: a way to the target is sought on it
/// when a detector says trap, and again every second and whenever something comes to light on it.
/// Its corners are virtual targets for the controller; a robot that does not get on so is led by
/// motions along the way. The escape ends where the rest of the way hardly leads away from the
/// target, and nearer to it than the escape before ended; `unreachable` where the obstacles that
/// are certain part the robot from the target.
class MapFollowing : public Escape {
 public:
  using Parameters = MapFollowingParameters;

  struct State {
    double ended_at_m = std::numeric_limits<double>::infinity();  ///< from the target, at least
    double least_length_m = 0.0;                ///< of the way still to go, so far
    core::Vec2 held_odom = core::Vec2::Zero();  ///< where the robot was led from last
    std::uint64_t held_tick = 0;                ///< since when
    std::int64_t proofs = 0;                    ///< times that what was seen closed every way
    std::uint64_t progress_tick = 0;            ///< when that was last undercut
  };

  MapFollowing(const Parameters& parameters, const domain::BehaviourSetup& setup,
               std::unique_ptr<map::PathSearch> search);

  bool reads_local_map() const override { return true; }
  void begin(const Situation& situation, const TrapEvidence& evidence) override;
  EscapeStatus step(const Situation& situation, domain::Guidance& guidance) override;
  void save(core::StateWriter& writer) const override;
  void load(core::StateReader& reader) override;

 private:
  void note_where_held(const Situation& situation, const core::Vec2& corner_odom);
  bool gets_on(const Situation& situation, bool planned);
  domain::Motion motion_to(const Situation& situation, const core::Vec2& place_odom) const;

  Parameters parameters_;
  double tick_s_;
  domain::MotionLimits limits_;
  map::LocalPath path_;
  State state_;
};

/// That on the neural map of Lagoudakis & Maida 1999.
class RememberedMap final : public MapFollowing {
 public:
  using MapFollowing::MapFollowing;
  static core::Result<std::unique_ptr<RememberedMap>> create(const Parameters& parameters,
                                                             const domain::BehaviourSetup& setup);
};

/// The honest rival: that on replanning A*.
class RememberedAStar final : public MapFollowing {
 public:
  using MapFollowing::MapFollowing;
  static core::Result<std::unique_ptr<RememberedAStar>> create(const Parameters& parameters,
                                                               const domain::BehaviourSetup& setup);
};

template <typename Visitor>
void visit_fields(Visitor& visit, MapFollowing::State& s) {
  visit(s.ended_at_m, s.least_length_m, s.held_odom, s.held_tick, s.proofs, s.progress_tick);
}

}  // namespace clew::recover

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/archive.hpp"
#include "domain/setup.hpp"
#include "map/costmap.hpp"
#include "map/path_search.hpp"
#include "recover/situation.hpp"

namespace clew::recover {

struct KnownWayParameters {
  double replan_s = 1.0;
  double look_ahead_m = 1.0;
  double comfortable_m = 0.1;
  double narrow_cost = 2.0;
  double suspected_cost = 20.0;
  double known_cost = 2.0;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, KnownWayParameters& p) {
  visit.number("replan_s", p.replan_s, "s", {0.0, 60.0}, "a way is sought again after this time");
  visit.number("look_ahead_m", p.look_ahead_m, "m", {0.0, 100.0},
               "or if something seen since lies on so much of it");
  visit.number("comfortable_m", p.comfortable_m, "m", {0.0, 1.0},
               "room beside the body from which on more is not better");
  visit.number("narrow_cost", p.narrow_cost, "1", {1.0, 20.0},
               "a metre with no room beside the body counts as this many");
  visit.number("known_cost", p.known_cost, "1", {1.0, 100.0},
               "a metre through what was seen free counts as this many");
  visit.number("suspected_cost", p.suspected_cost, "1", {1.0, 100.0},
               "a metre through suspected obstacles counts as this many");
}

/// The way to the target on all that a robot has seen: what *remembered_map*, *remembered_astar*
/// and *known_detour* share. Situations must have surroundings, always the same ones.
///
/// Unknown counts as free, and a suspected obstacle as dear, so the way leads there only where
/// nothing else is left; going there shows what is the case. That there is no way is a proof: the
/// hits alone part the robot from the target, each held for smaller than the robot by all that
/// roundings come to.
class KnownWay {
 public:
  struct State {
    std::vector<core::Vec2> corners_odom;  ///< of the way, the robot's place then first
    std::vector<core::Vec2> refused_odom;  ///< where the robot tried to go and could not
    std::uint32_t next = 0;                ///< corner that the robot is on its way to
    std::uint64_t planned_tick = 0;
    bool planned = false;
  };

  KnownWay(const KnownWayParameters& parameters, const domain::BehaviourSetup& setup,
           std::unique_ptr<map::PathSearch> search);

  /// Seeks a way if there is none yet, the last one is old, or something seen since lies on it.
  /// True if it sought.
  bool keep_up(const Situation& situation);
  /// Seeks a way.
  void plan(const Situation& situation);
  /// The robot cannot get to this place, whatever is seen: it has tried.
  void refuse(const core::Vec2& place_odom);
  /// Forgets the way, and where the robot could not get to.
  void forget_all() { state_ = {}; }
  /// What is known of ways is void.
  void forget_way() { state_.planned = false; }

  bool has_way() const { return !state_.corners_odom.empty(); }
  /// The corner that the robot must go to now, `reach_m` being near enough, but at the last one.
  const core::Vec2& next_corner(const Situation& situation, double reach_m);
  /// From the robot along the way.
  double length_m(const Situation& situation) const;
  /// How much farther from the target the way leads than a place on it before, from the robot on.
  double rise_m(const Situation& situation) const;

  void save(core::StateWriter& writer) const;
  void load(core::StateReader& reader);

 private:
  void make_clearance(const SurroundingsParameters& surroundings);
  void close_refused(map::Costmap& costs) const;
  void open_own_place(map::Costmap& costs, const core::Vec2& place);
  bool is_cut(const Situation& situation) const;
  void pull_tight(const map::Costmap& costs, const std::vector<core::Vec2>& way,
                  const core::Vec2& from);
  void centre_corners(const map::SeenMap& seen, double cell_m);

  KnownWayParameters parameters_;
  double radius_m_;
  double replan_ticks_;
  map::Inflation inflation_;
  std::optional<map::CostmapBuilder> clearance_;  // made with the first way that is sought
  std::unique_ptr<map::PathSearch> search_;
  std::vector<core::Vec2> hits_odom_;  // memory to work in
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, KnownWay::State& s) {
  visit(s.corners_odom, s.refused_odom, s.next, s.planned_tick, s.planned);
}

}  // namespace clew::recover

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/archive.hpp"
#include "core/parameters.hpp"
#include "core/result.hpp"
#include "domain/setup.hpp"
#include "map/astar.hpp"
#include "map/costmap.hpp"
#include "plan/planner.hpp"

namespace clew::plan {

struct AStarPlannerParameters {
  double replan_s = 0.1;
  double narrow_cost = 2.0;
  double suspected_cost = 20.0;
  double touching_cost = 40.0;
  double look_ahead_s = 1.0;
  double least_look_ahead_m = 0.25;
  double most_look_ahead_m = 0.8;
  double held_s = 8.0;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, AStarPlannerParameters& p) {
  visit.number("replan_s", p.replan_s, "s", {0.0, 60.0},
               "the path is planned again after this time, and at once where it is cut");
  visit.number("narrow_cost", p.narrow_cost, "1", {1.0, 20.0},
               "cost of a metre with less clearance beside the body than margin_m");
  visit.number("suspected_cost", p.suspected_cost, "1", {1.0, 100.0},
               "cost of a metre through suspected obstacles");
  visit.number("touching_cost", p.touching_cost, "1", {1.0, 1000.0},
               "cost of a metre on which the body is believed to touch");
  visit.number("look_ahead_s", p.look_ahead_s, "s", {0.0, 60.0},
               "the place to pursue is as far along the path as the robot goes in this time");
  visit.number("least_look_ahead_m", p.least_look_ahead_m, "m", {0.01, 10.0},
               "the place to pursue is at least this far along the path");
  visit.number("most_look_ahead_m", p.most_look_ahead_m, "m", {0.01, 100.0},
               "the place to pursue is at most this far along the path");
  visit.number("held_s", p.held_s, "s", {0.1, 1000.0},
               "a place is closed if the robot is held before it for this time; longer where it is "
               "slow or its ticks are long");
}

/// Plans as a navigation stack does: a path of least cost by A* over the map, sought again every
/// `replan_s`, and on it the place to pursue (Coulter 1992; the distance ahead grows with the speed
/// and has bounds, as in Macenski et al. 2023, "Regulated pure pursuit for robot path following").
/// With `map: seen`, unknown counts as free: the free-space assumption. It is the rival that our
/// own recovery is measured against, so it is as good as we can make it.
///
/// Cells with margin_m beside the body cost 1 a metre; with less, `narrow_cost`; more where
/// something is suspected or believed to touch. The path is pulled tight where that costs no more.
///
/// *Deviations*, each makes it better: the place to pursue comes nearer, down to a quarter, where
/// no straight line leads to it, so that pursuit does not cut corners; where the straight line to
/// the target is open nothing is sought; and a place before which the robot is held for `held_s` is
/// closed, in place of the recoveries of a behaviour tree. Where no path is left, all of them are
/// open again: what stood there may have gone.
///
/// Where there is no path the target itself is the subgoal.
class AStarPlanner final : public Planner {
 public:
  using Parameters = AStarPlannerParameters;
  struct State {
    std::vector<core::Vec2> path;    ///< its corners, the robot's place then first
    std::vector<core::Vec2> closed;  ///< where the robot was held
    std::uint32_t piece = 0;  ///< of the path, that the robot is beside: begins at this corner
    bool planned = false;
    std::uint64_t planned_tick = 0;
    core::Vec2 target = core::Vec2::Zero();  ///< that it was planned to
    core::Vec2 held = core::Vec2::Zero();    ///< where the robot has been since held_tick
    std::uint64_t held_tick = 0;
  };

  static core::Result<std::unique_ptr<AStarPlanner>> create(const Parameters& parameters,
                                                            const domain::BehaviourSetup& setup);
  AStarPlanner(const Parameters& parameters, const domain::BehaviourSetup& setup);

  Subgoal step(const Situation& situation) override;
  void tell(const Situation& situation, domain::Inside& inside) const override;
  void save(core::StateWriter& writer) const override;
  void load(core::StateReader& reader) override;

 private:
  /// A place on the path, and whether it is the path's end.
  struct Ahead {
    core::Vec2 place;
    bool is_end;
  };

  void note_where_held(const Situation& situation);
  bool is_old(const Situation& situation) const;
  bool is_cut(const Situation& situation, const core::Vec2& robot) const;
  void plan(const Situation& situation);
  void charge(const RoomView& view, const core::Vec2& robot);
  float cost_of(map::Clearance room) const;
  double pass(const core::Vec2& robot);
  Ahead ahead(double along_m) const;
  Subgoal pursued(const Situation& situation, const core::Vec2& robot);

  Parameters parameters_;
  double tick_s_;
  std::uint64_t held_ticks_;
  map::AStar search_;
  map::Costmap costs_;
  std::vector<map::Cell> cells_;  // memory to work in
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, AStarPlanner::State& s) {
  visit(s.path, s.closed, s.piece, s.planned, s.planned_tick, s.target, s.held, s.held_tick);
}

}  // namespace clew::plan

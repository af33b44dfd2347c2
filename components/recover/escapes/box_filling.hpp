// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "core/result.hpp"
#include "domain/setup.hpp"
#include "recover/escapes/boxes.hpp"
#include "recover/escapes/escape.hpp"
#include "recover/escapes/goal_stack.hpp"
#include "recover/trail.hpp"

namespace clew::recover {

struct BoxFillingParameters {
  double beyond_m = 1.0;
  double close_m = 0.3;
  double clearance_m = 0.5;
  double least_size_m = 0.2;
  double recent_m = 3.0;
  double patience_s = 30.0;
  double goal_patience_s = 180.0;
  double trail_spacing_m = 0.1;
  std::int64_t trail_capacity = 2048;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, BoxFillingParameters& p) {
  visit.number("beyond_m", p.beyond_m, "m", {0.0, 10.0},
               "distance from the side of a virtual obstacle to its subgoal");
  visit.number("close_m", p.close_m, "m", {0.01, 10.0},
               "a subgoal is reached within this distance");
  visit.number("clearance_m", p.clearance_m, "m", {0.0, 10.0},
               "clearance that virtual obstacles keep from the target and the subgoals");
  visit.number("least_size_m", p.least_size_m, "m", {0.01, 10.0},
               "least width and height of a virtual obstacle");
  visit.number("recent_m", p.recent_m, "m", {0.1, 1000.0},
               "length of the path back that is boxed, for traps without an earlier visit");
  visit.number("patience_s", p.patience_s, "s", {0.1, 100000.0},
               "a subgoal is dropped if the robot does not come nearer for this time");
  visit.number("goal_patience_s", p.goal_patience_s, "s", {0.1, 100000.0},
               "the newest virtual obstacle shrinks if the robot does not come nearer to the "
               "target for this time");
  visit.number("trail_spacing_m", p.trail_spacing_m, "m", {0.01, 10.0},
               "spacing of the stored positions of the path back");
  visit.integer("trail_capacity", p.trail_capacity, "1", {2, 1000000},
                "greatest number of stored positions of the path back");
}

/// Virtual obstacles and the goal stack of Pin & Bender 1996. A virtual obstacle is the bounding
/// box of all positions between the two encounters of a limit cycle; the control component lets it
/// override readings that are longer, but for a robot that is still inside. A subgoal one metre
/// beyond the midpoint of the side opposite the previous goal goes on the stack; reached, it leads
/// back to the goal below. Further traps add further boxes, until the dead end is filled; the
/// escape goes on until the target is reached, since the boxes must stay.
///
/// Readings of ours, where the paper is silent: a trap without an earlier visit bounds the last
/// recent_m of the path. Boxes keep clear of the target and of subgoals. A subgoal is dropped if
/// the robot does not come nearer to it. If the robot does not come nearer to the target for
/// goal_patience_s, the newest box, which may close the only way out, is halved, and removed when
/// it is smaller than least_size_m. The escape fails when there are no boxes left to remove, or no
/// room for another.
class BoxFilling final : public Escape {
 public:
  using Parameters = BoxFillingParameters;

  struct State {
    core::BoundedVector<VirtualObstacle, domain::kMaxVirtualObstacles> boxes;  ///< the newest last
    bool full = false;              ///< a trap needed one box too many
    double target_least_m = 0.0;    ///< distance to the mission's target, since the last subgoal
    std::uint64_t target_tick = 0;  ///< when that was last undercut
  };

  static core::Result<std::unique_ptr<BoxFilling>> create(const Parameters& parameters,
                                                          const domain::BehaviourSetup& setup);
  /// A tick lasts `tick_s`.
  BoxFilling(const Parameters& parameters, double tick_s);

  void watch(const Situation& situation) override;
  void begin(const Situation& situation, const TrapEvidence& evidence) override;
  bool take_up(const Situation& situation, const TrapEvidence& evidence) override;
  EscapeStatus step(const Situation& situation, domain::Guidance& guidance) override;
  void tell(const Situation& situation, domain::Inside& inside) const override;
  void save(core::StateWriter& writer) const override;
  void load(core::StateReader& reader) override;

 private:
  void keep_clear_of(const core::Vec2& point_odom);
  void pursue_target_anew(const Situation& situation);
  void watch_target(const Situation& situation);

  Parameters parameters_;
  double tick_s_;
  Trail trail_;
  GoalStack stack_;
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, BoxFilling::State& s) {
  visit(s.boxes, s.full, s.target_least_m, s.target_tick);
}

}  // namespace clew::recover

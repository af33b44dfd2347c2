// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "domain/setup.hpp"
#include "map/neural_map.hpp"
#include "plan/planner.hpp"

namespace clew::plan {

/// Subgoals along the path of steepest ascent of a neural map (Lagoudakis & Maida 1999; the paper
/// places those of its figure 9 by hand).
///
/// The map is spread from the target over all places where the robot has room to spare; if that
/// leaves no way, over those where it just fits near the target, then everywhere, and on what was
/// seen over those where it is not believed, and then not proved, to touch. So a target beside a
/// wall does not lead the path past every corner as closely, where a guard holds the robot. The
/// ascent is followed over the interpolated landscape (map/smooth_path.hpp), or from cell to cell.
/// The subgoal is the farthest point of the path within `look_ahead_m` that a straight line over
/// such places leads to, and is kept until the robot is within `arrive_m` of it, or no straight
/// line leads to it any more for `replan_s`, when the path is made anew from where the robot is.
/// A target that lies in a narrow place is come to by the first place of the path from which it is
/// straight ahead, and that is kept until the robot is there: beside it, the robot would stand
/// before a wall. Where the map changes, that happens every `refresh_s`, too. Where there is no
/// way, the target itself is the subgoal.
class NeuralMapPlanner final : public Planner {
 public:
  struct Parameters {
    map::Lattice lattice = map::Lattice::kEightNeighbours;
    double gain = 0.1;
    bool smooth = true;
    double look_ahead_m = 3.0;
    double arrive_m = 0.3;
    double replan_s = 1.5;
    double refresh_s = 1.0;
    double come_in_m = 1.2;
  };

  struct State {
    std::vector<core::Vec2> path;                 ///< from where it was made to the target's place
    std::uint32_t subgoal = 0;                    ///< index in the path
    map::Clearance room = map::Clearance::kOpen;  ///< that the path has, but near the target
    bool planned = false;
    std::uint64_t planned_tick = 0;
    core::Vec2 target = core::Vec2::Zero();  ///< that it was planned to
    bool astray = false;                     ///< no straight line leads to the subgoal
    std::uint64_t astray_since = 0;          ///< tick, if astray
  };

  static core::Result<std::unique_ptr<NeuralMapPlanner>> create(
      const Parameters& parameters, const domain::BehaviourSetup& setup);

  Subgoal step(const Situation& situation) override;
  void tell(const Situation& situation, domain::Inside& inside) const override;
  void save(core::StateWriter& writer) const override;
  void load(core::StateReader& reader) override;

 private:
  void tell_landscape(const core::Vec2& robot, domain::Inside& inside) const;
  void draw_landscape(domain::Picture& picture) const;
  double most_active_of(const map::Cell& first, std::int32_t side) const;
  NeuralMapPlanner(const Parameters& parameters, map::NeuralMap landscape,
                   const domain::BehaviourSetup& setup)
      : parameters_(parameters),
        radius_m_(setup.robot.radius_m),
        tick_s_(setup.tick_s),
        landscape_(std::move(landscape)) {}

  void plan(const Situation& situation);
  bool make_path(const Situation& situation);
  std::size_t find_passable(const RoomView& view, map::Clearance least, const core::Vec2& target,
                            double narrow_m);
  bool comes_in(const Situation& situation) const;
  bool is_mouth(const Situation& situation, std::uint32_t point) const;
  double near_enough_m(const Situation& situation) const;
  bool is_old(const Situation& situation) const;
  std::vector<map::Cell> target_units(const Situation& situation) const;
  std::optional<map::Cell> nearest_unit(const core::Vec2& place) const;
  void choose_subgoal(const Situation& situation);
  void notice_astray(const Situation& situation);

  Parameters parameters_;
  double radius_m_;
  double tick_s_;
  map::NeuralMap landscape_;
  map::Grid units_;                     // of the landscape
  std::vector<map::Cell> cells_;        // of the path
  std::vector<std::uint8_t> passable_;  // by the cell of the map that a unit lies in
  State state_;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, NeuralMapPlanner::Parameters& p) {
  visit.choice("lattice", p.lattice,
               {{"four", map::Lattice::kFourNeighbours},
                {"eight", map::Lattice::kEightNeighbours},
                {"hexagonal", map::Lattice::kHexagonal}},
               "how the neurons are linked: square with four or eight neighbours, or hexagonal");
  visit.number(
      "gain", p.gain, "1", {0.001, 0.25},
      "steepest slope of the activation, below 0.25 (four), 0.146 (eight), 0.166 (hexagonal)");
  visit.flag("smooth", p.smooth,
             "true: the path is interpolated; false: it leads from cell to cell");
  visit.number("look_ahead_m", p.look_ahead_m, "m", {0.1, 100.0}, "greatest distance of a subgoal");
  visit.number("arrive_m", p.arrive_m, "m", {0.01, 10.0},
               "a subgoal is reached within this distance; then the next one is taken");
  visit.number("replan_s", p.replan_s, "s", {0.0, 60.0},
               "the path is planned again if no straight line reaches the subgoal for this time");
  visit.number("refresh_s", p.refresh_s, "s", {0.0, 60.0},
               "for map: seen, the path is planned again after this time");
  visit.number("come_in_m", p.come_in_m, "m", {0.0, 100.0},
               "within this distance and with a free straight line, the target is the subgoal");
}

template <typename Visitor>
void visit_fields(Visitor& visit, NeuralMapPlanner::State& s) {
  visit(s.path, s.subgoal, s.room, s.planned, s.planned_tick, s.target, s.astray, s.astray_since);
}

}  // namespace clew::plan

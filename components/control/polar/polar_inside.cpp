// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "control/polar/polar_neural_map.hpp"
#include "control/polar/polar_picture.hpp"
#include "domain/words.hpp"

namespace clew::control {
namespace {

/// The logarithm of the activation by ring and sector; what is at 0 as low as the least.
void tell_activation(const PolarLandscape& landscape, const std::optional<PolarUnit>& subgoal,
                     domain::Inside& inside) {
  const PolarLattice& lattice = landscape.lattice();
  domain::InsideGrid activation{
      lattice.sectors(), {}, "sector, counter-clockwise from the target", "ring, outward", {}};
  double least = 0.0;
  std::size_t obstructed = 0;
  for (std::size_t ring = 0; ring < lattice.rings(); ++ring) {
    for (std::size_t sector = 0; sector < lattice.sectors(); ++sector) {
      const PolarUnit unit{ring, sector};
      const double log = landscape.log_activation(unit);
      if (std::isfinite(log)) least = std::min(least, log);
      if (landscape.obstructed(unit)) ++obstructed;
      activation.values.push_back(log);
    }
  }
  for (double& value : activation.values) {
    if (!std::isfinite(value)) value = least - 1.0;
  }
  if (subgoal) activation.marked = subgoal->ring * lattice.sectors() + subgoal->sector;
  inside.values.number("obstructed_units", static_cast<double>(obstructed));
  inside.values.grid("log_activation", std::move(activation));
}

/// The objective of each velocity, without braking, which is another choice.
void tell_window(const DynamicWindow& window, domain::Inside& inside) {
  const auto& cells = window.cells();
  domain::InsideGrid objective{
      window.turn_rates(), {}, "turn rate, from the window's right", "speed, from the least", {}};
  std::size_t in_time = 0;
  for (std::size_t i = 0; i + 1 < cells.size(); ++i) {
    objective.values.push_back(cells[i].objective_m);
    if (cells[i].stops_in_time) ++in_time;
  }
  const WindowCell& chosen = cells[window.chosen()];
  const bool brakes = window.chosen() + 1 == cells.size();
  if (!brakes) objective.marked = window.chosen();
  domain::InsideGroup& group = inside.values.group("dynamic_window");
  group.number("velocities", static_cast<double>(cells.size() - 1));
  group.number("that_stop_in_time", static_cast<double>(in_time));
  group.number("chosen_speed", chosen.speed_mps, "mps");
  group.number("chosen_turn_rate", chosen.turn_rate_radps, "radps");
  group.number("chosen_objective", chosen.objective_m, "m");
  group.flag("brakes", brakes);
  group.grid("objective", std::move(objective), "m");
  inside.say(std::to_string(in_time) + " of " + std::to_string(cells.size() - 1) +
             " velocities in the dynamic window stop in time. " +
             (brakes ? "None is taken: the robot brakes."
                     : "The best one has an objective of " +
                           domain::say_metres(chosen.objective_m) + "."));
}

}  // namespace

void PolarNeuralMap::tell(const domain::Odometry& odometry, const domain::Scan&, const core::Vec2&,
                          domain::Inside& inside) const {
  const auto subgoal = landscape_.subgoal();
  std::vector<core::Vec2> returns;
  memory_.returns_seen_from(pose_odom_map_, parameters_.scope_m, returns);
  inside.values.number("remembered_returns", static_cast<double>(returns.size()));
  inside.values.place("predicted_position", pose_odom_map_.position());
  inside.values.number("predicted_cycle", prediction_.cycle_s(), "s");
  inside.values.flag("has_subgoal", subgoal.has_value());
  const core::Pose2& pose = odometry.pose_odom_robot;
  inside.say(domain::say_count(returns.size(), "remembered return") +
             " obstruct the map, which is drawn where the robot will be in " +
             domain::say_seconds(prediction_.cycle_s()) + ".");
  if (subgoal) {
    inside.values.place("subgoal", subgoal_odom_);
    inside.say("Activation rises as far as the subgoal, " +
               domain::say_metres(core::distance_m(pose, subgoal_odom_)) + " away, " +
               domain::say_bearing(core::bearing_rad(pose, subgoal_odom_)) + ".");
  } else {
    inside.say("Activation does not reach the robot, so it turns on the spot to look for a way.");
  }
  tell_activation(landscape_, subgoal, inside);
  tell_window(window_, inside);
  draw(inside.picture);
}

void PolarNeuralMap::draw(domain::Picture& picture) const {
  draw_landscape(landscape_, pose_odom_map_, picture);
  domain::PictureLayer remembered{
      "remembered returns", domain::PictureLayer::Kind::kPoints, {}, {}};
  std::vector<core::Vec2> returns;
  memory_.returns_seen_from(pose_odom_map_, parameters_.scope_m, returns);
  const core::Vec2 ahead = core::direction(pose_odom_map_.heading_rad);
  for (const core::Vec2& place : returns) {
    remembered.places_odom.push_back(pose_odom_map_.position() +
                                     core::Vec2(ahead.x() * place.x() - ahead.y() * place.y(),
                                                ahead.y() * place.x() + ahead.x() * place.y()));
  }
  picture.layers.push_back(std::move(remembered));
  draw_window(window_, pose_odom_robot_, prediction_.cycle_s(), picture);
  if (landscape_.subgoal()) {
    picture.layers.push_back({"subgoal", domain::PictureLayer::Kind::kGoal, {}, {subgoal_odom_}});
  }
}

}  // namespace clew::control

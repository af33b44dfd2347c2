// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "control/polar/lanes.hpp"
#include "core/angle.hpp"
#include "core/geometry.hpp"
#include "domain/setup.hpp"

namespace clew::control {

struct DynamicWindowParameters {
  double max_speed_mps = 0.6096;
  double max_turn_rate_radps = core::radians(45.0);
  double max_acceleration_mps2 = 0.5;
  double max_turn_acceleration_radps2 = core::radians(90.0);
  std::int64_t speeds = 7;
  std::int64_t turn_rates = 15;
  double heading_weight_m_per_rad = 0.3;
  double density_weight_m = 0.3;
  double density_reach_m = 0.3;
  double stop_margin_m = 0.06;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, DynamicWindowParameters& p) {
  visit.number("max_speed_mps", p.max_speed_mps, "m/s", {0.01, 10.0},
               "greatest speed, or that of the drive if lower");
  visit.number("max_turn_rate_radps", p.max_turn_rate_radps, "rad/s", {0.01, 20.0},
               "greatest turn rate, or that of the drive if lower");
  visit.number("max_acceleration_mps2", p.max_acceleration_mps2, "m/s^2", {0.01, 100.0},
               "greatest acceleration, or that of the drive if lower");
  visit.number("max_turn_acceleration_radps2", p.max_turn_acceleration_radps2, "rad/s^2",
               {0.01, 100.0}, "greatest turn acceleration, or that of the drive if lower");
  visit.integer("speeds", p.speeds, "1", {2, 31}, "number of speeds in the dynamic window");
  visit.integer("turn_rates", p.turn_rates, "1", {3, 61},
                "number of turn rates in the dynamic window");
  visit.number("heading_weight_m_per_rad", p.heading_weight_m_per_rad, "m/rad", {0.0, 10.0},
               "weight of a radian off the subgoal's direction, against a metre off its position");
  visit.number(
      "density_weight_m", p.density_weight_m, "m", {0.0, 10.0},
      "weight of full obstacle density along the path, against a metre off the subgoal's position");
  visit.number("density_reach_m", p.density_reach_m, "m", {0.01, 5.0},
               "obstacle density falls from 1 at the stop margin to 0 over this distance");
  visit.number("stop_margin_m", p.stop_margin_m, "m", {0.0, 1.0},
               "clearance beside the body on the path to a stop");
}

/// A point of the velocity space.
struct WindowCell {
  double speed_mps = 0.0;
  double turn_rate_radps = 0.0;
  double objective_m = 0.0;
  bool stops_in_time = true;  ///< its way, braking included, leads past all returns
};

/// Chooses velocities that chase a subgoal: Lagoudakis & Maida 1999, *Motion Control*. The dynamic
/// window (Fox, Burgard & Thrun 1997) is what the accelerations allow in one cycle. Of each pair on
/// a grid over it, and of braking, the way is told that the robot goes in a cycle and until it has
/// come to rest. The objective, in metres, is
///
///     |stop - subgoal| + w_h |heading at the stop - direction of the subgoal| + w_d density,
///
/// the subgoal being a configuration (a place and the heading toward it); density is the mean over
/// the way of the nearness of the nearest return, from 1 at the robot's skin and the margin to 0
/// density_reach_m farther on. The least one is chosen.
///
/// *Our reading.* Braking keeps the curvature: with accelerations a and alpha both velocities fall
/// to 0 in T = max(v / a, |omega| / alpha), so the way is one arc of length v (t + T / 2), t the
/// cycle. Density is that of the returns themselves, not of the units that they obstruct, which lie
/// a hand's breadth apart where the robot is.
///
/// *Deviation, needed:* a pair is out of question if its way leads nearer to what is seen now than
/// the robot's radius and the margin, or nearer than now. Where none is left but braking, it
/// brakes. What is remembered counts in the density only: with a laser, one reading in a hundred
/// being wrong, ten scans hold so many errors that no way would be left.
class DynamicWindow {
 public:
  /// Where and which way to come to rest, in the robot's frame.
  struct Goal {
    core::Vec2 place = core::Vec2::Zero();
    double heading_rad = 0.0;
  };

  DynamicWindow(const DynamicWindowParameters& parameters, const domain::MotionLimits& drive,
                double radius_m);

  /// How far the longest way in the window, and what counts of the density beside it, may reach.
  double reach_m(double cycle_s) const;

  /// The best of the window around the present velocities. Points of obstacles in the robot's
  /// frame: seen now, and remembered.
  const WindowCell& choose(double speed_mps, double turn_rate_radps, double cycle_s,
                           const Goal& goal, const std::vector<core::Vec2>& seen,
                           const std::vector<core::Vec2>& remembered);

  /// The window of the last choice: speeds by turn rates, row-major by speed; braking is last.
  const std::vector<WindowCell>& cells() const { return cells_; }
  std::size_t chosen() const { return chosen_; }
  /// The time that its velocities would take for the way of a cell, braking included.
  double lasts_s(const WindowCell& cell, double cycle_s) const {
    return cycle_s + 0.5 * braking_s(cell.speed_mps, cell.turn_rate_radps);
  }
  std::size_t turn_rates() const { return static_cast<std::size_t>(parameters_.turn_rates); }

 private:
  static constexpr std::size_t kSamples = 8;  // of a way
  static_assert(kSamples % kLanes == 0, "a way's samples fill lanes");

  void lay_out(double speed_mps, double turn_rate_radps, double cycle_s);
  void follow(std::size_t cell, double cycle_s);
  void box_ways();
  bool can_matter(const core::Vec2& place) const;
  void measure_seen(const core::Vec2& place);
  void measure_remembered(const core::Vec2& place);
  Lanes distance2_m2(std::size_t sample, const core::Vec2& place) const;
  double braking_s(double speed_mps, double turn_rate_radps) const;
  double density(std::size_t cell) const;

  DynamicWindowParameters parameters_;
  domain::MotionLimits limits_;
  double keep_m_;
  std::vector<WindowCell> cells_;
  std::size_t chosen_ = 0;
  // Of the samples of all ways, one after the other.
  std::vector<double> x_m_;
  std::vector<double> y_m_;
  std::vector<double> nearest2_m2_;  // squared distance to the nearest return
  std::vector<double> excess_m2_;    // least of squared distance to what is seen less what is kept
  std::vector<core::Pose2> stops_;   // by cell
  // Corners of a box around all of them and what may matter to them.
  core::Vec2 least_ = core::Vec2::Zero();
  core::Vec2 most_ = core::Vec2::Zero();
};

}  // namespace clew::control

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "control/controller.hpp"
#include "core/angle.hpp"
#include "core/parameters.hpp"
#include "core/result.hpp"
#include "domain/setup.hpp"

namespace clew::control {

struct RegulatedPurePursuitParameters {
  double speed_mps = 0.6;
  double least_speed_mps = 0.1;
  double curve_radius_m = 0.5;
  double near_m = 0.2;
  double slow_before_m = 0.0;
  double turn_first_rad = core::radians(60.0);
  double turn_rate_radps = 3.0;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, RegulatedPurePursuitParameters& p) {
  visit.number("speed_mps", p.speed_mps, "m/s", {0.01, 10.0},
               "greatest speed, or that of the drive if lower");
  visit.number("least_speed_mps", p.least_speed_mps, "m/s", {0.01, 10.0},
               "curves, obstacles and the target slow the robot down to this at most");
  visit.number("curve_radius_m", p.curve_radius_m, "m", {0.0, 10.0},
               "curves of a smaller radius are driven slower, in proportion");
  visit.number("near_m", p.near_m, "m", {0.0, 5.0},
               "obstacles nearer than this to the body slow the robot down, in proportion");
  visit.number("slow_before_m", p.slow_before_m, "m", {0.0, 10.0},
               "within this distance of the place pursued it slows down, in proportion; 0: never");
  visit.angle("turn_first_deg", p.turn_first_rad, {1.0, 180.0},
              "greater turns are made on the spot");
  visit.number("turn_rate_radps", p.turn_rate_radps, "rad/s", {0.01, 20.0},
               "greatest turn rate, or that of the drive if lower");
}

/// Pursues a place that moves ahead of the robot on a path (*plan*'s `astar`), along the arc that
/// leads there, and slower where that is due: Macenski, Singh, Martin & Gines 2023, "Regulated pure
/// pursuit for robot path following", Autonomous Robots 47, after Coulter 1992. With the place at
/// distance L and bearing b, the arc's curvature is
///
///     kappa = 2 y / L^2 = 2 sin b / L,
///
/// and the speed the least of v, v / (kappa r_min) where the curve is tighter than r_min, v d /
/// d_near where an obstacle is nearer than d_near, and v L / L_slow near the place; at least
/// `least_speed_mps`. A place more than `turn_first_deg` off is turned to on the spot.
///
/// *Deviations:* obstacles are the scan's, since a controller has no map. The speed is lowered,
/// too, where the arc asks for more turn rate than the drive has, and turns on the spot are as fast
/// as lets them end in time. What the paper's collision check stops is the step guard's matter. It
/// has no state.
class RegulatedPurePursuit final : public Controller {
 public:
  using Parameters = RegulatedPurePursuitParameters;

  static core::Result<std::unique_ptr<RegulatedPurePursuit>> create(
      const Parameters& parameters, const domain::BehaviourSetup& setup);
  RegulatedPurePursuit(const Parameters& parameters, const domain::BehaviourSetup& setup)
      : parameters_(parameters), tick_s_(setup.tick_s), limits_(setup.limits) {}

  domain::Motion step(const domain::Odometry& odometry, const domain::Scan& scan,
                      const core::Vec2& target_odom) override;
  void save(core::StateWriter&) const override {}
  void load(core::StateReader&) override {}
  void tell(const domain::Odometry& odometry, const domain::Scan& scan,
            const core::Vec2& target_odom, domain::Inside& inside) const override;

 private:
  /// The arc to the place, and the speeds that are allowed on it.
  struct Pursuit {
    double distance_m = 0.0;
    double bearing_rad = 0.0;
    double curvature_per_m = 0.0;
    double speed_mps = 0.0;     ///< what the drive and the parameters allow
    double in_curve_mps = 0.0;  ///< on this arc
    double beside_obstacle_mps = 0.0;
    double before_place_mps = 0.0;
    double chosen_mps = 0.0;
  };

  Pursuit pursue(const domain::Odometry& odometry, const domain::Scan& scan,
                 const core::Vec2& target_odom) const;
  double turn_rate_on_spot_radps(double bearing_rad) const;
  double most_turn_rate_radps() const;

  Parameters parameters_;
  double tick_s_;
  domain::MotionLimits limits_;
};

}  // namespace clew::control

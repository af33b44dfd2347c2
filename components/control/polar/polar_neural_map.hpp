// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "control/controller.hpp"
#include "control/polar/dynamic_window.hpp"
#include "control/polar/polar_landscape.hpp"
#include "control/polar/pose_prediction.hpp"
#include "control/polar/scan_memory.hpp"
#include "core/result.hpp"
#include "domain/setup.hpp"

namespace clew::control {

struct PolarNeuralMapParameters {
  std::int64_t rings = 100;
  std::int64_t sectors = 32;
  double scope_m = 2.54;
  double gain_ratio = 0.7;
  std::int64_t most_patterns = 8;
  double memory_s = 2.5;
  bool predict = true;
  double clearance_m = 0.07;
  DynamicWindowParameters window;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, PolarNeuralMapParameters& p) {
  visit.integer("rings", p.rings, "1", {4, 400},
                "number of rings of the map, with the robot's own place");
  visit.integer("sectors", p.sectors, "1", {8, 256}, "number of sectors of the map");
  visit.number("scope_m", p.scope_m, "m", {0.5, 20.0}, "radius of the outer ring");
  visit.number("gain_ratio", p.gain_ratio, "1", {0.05, 0.99},
               "beta times the greatest eigenvalue of the connectivity; stable below 1");
  visit.integer("most_patterns", p.most_patterns, "1", {1, 1000},
                "greatest number of update patterns in a tick; fewer if the subgoal is stable");
  visit.number("memory_s", p.memory_s, "s", {0.0, 10.0},
               "time that the short-term memory covers, to whole scans; 0: the present scan alone");
  visit.flag("predict", p.predict,
             "whether the map is centred where the robot will be after a cycle");
  visit.number("clearance_m", p.clearance_m, "m", {0.0, 1.0},
               "clearance beside the body: returns nearer than this to it block units");
  visit_parameters(visit, p.window);
}

/// The local navigation system of Lagoudakis & Maida 1999: returns of the last scans obstruct units
/// of a polar neural map around the robot; activation spreads from the target, or from the outer
/// ring in its direction; the best sector at the robot, followed as far as activation rises, is the
/// subgoal, which a dynamic window chases.
///
/// *Our reading.* The map is drawn where the robot will be at the end of the cycle, as in the
/// paper; the window begins where it is now, since here a command acts at once. Where the subgoal
/// is the target's unit, it is the target itself.
///
/// *Deviations, needed:*
/// - sector 0 lies in the direction of the target, not along the heading. So the target is on its
///   unit exactly, and the map does not turn under a robot that turns: else, before a pillar, the
///   better side changed with each sector that the target's direction crossed;
/// - returns obstruct what is nearer than the robot's radius and clearance_m, a little more than
///   the window keeps, so that it can follow the map. Where activation does not reach the robot
///   then, with half of that room, with none, and at last with the present scan alone;
/// - where it still does not, the robot comes to rest and turns on the spot, on the side that it
///   turns to already, or else that of the target, until a way shows;
/// - for the window, each beam of the present scan returns at both its ends as well as in its
///   middle, since the nearest thing in a cone may be anywhere on that arc.
class PolarNeuralMap final : public Controller {
 public:
  using Parameters = PolarNeuralMapParameters;

  /// Refuses a scan that leaves wide gaps, or does not show what is beside the robot.
  static core::Result<std::unique_ptr<PolarNeuralMap>> create(const Parameters& parameters,
                                                              const domain::BehaviourSetup& setup);

  PolarNeuralMap(const Parameters& parameters, const domain::BehaviourSetup& setup);

  domain::Motion step(const domain::Odometry& odometry, const domain::Scan& scan,
                      const core::Vec2& target_odom) override;
  void save(core::StateWriter& writer) const override;
  void load(core::StateReader& reader) override;
  void tell(const domain::Odometry& odometry, const domain::Scan& scan,
            const core::Vec2& target_odom, domain::Inside& inside) const override;

 private:
  void draw(domain::Picture& picture) const;
  core::Pose2 map_pose(const domain::Odometry& odometry, const core::Vec2& target_odom) const;
  void draw_map(const core::Vec2& target_map);
  bool spread_activation(double reach_m, const core::Vec2& target_map);
  DynamicWindow::Goal goal_on_map(const PolarUnit& subgoal, const core::Vec2& target_map) const;
  DynamicWindow::Goal turn_on_the_spot(const domain::Odometry& odometry,
                                       const core::Vec2& target_odom) const;
  void look_around(const core::Pose2& pose, double cycle_s, const domain::Scan& scan);

  Parameters parameters_;
  double radius_m_;
  PosePrediction prediction_;
  ScanMemory memory_;
  PolarLandscape landscape_;
  DynamicWindow window_;
  std::vector<core::Vec2> returns_;  // scratch
  std::vector<core::Vec2> seen_;     // scratch: where the beams of the present scan end
  // Scratch, of the last step.
  core::Pose2 pose_odom_robot_;
  core::Pose2 pose_odom_map_;
  core::Vec2 subgoal_odom_ = core::Vec2::Zero();
};

}  // namespace clew::control

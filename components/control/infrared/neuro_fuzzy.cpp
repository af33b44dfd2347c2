// SPDX-License-Identifier: Apache-2.0
#include "control/infrared/neuro_fuzzy.hpp"

#include <utility>

namespace clew::control {

core::Result<std::unique_ptr<NeuroFuzzy>> NeuroFuzzy::create(const Parameters& parameters,
                                                             const domain::BehaviourSetup& setup) {
  const auto infrareds = FourInfrareds::create(setup.scan, "neuro_fuzzy");
  if (!infrareds.ok()) return infrareds.error();
  const auto resource = setup.resources.find("rulebases", parameters.rules);
  if (!resource.ok()) return resource.error();
  const auto nets = NeuroFuzzyNets::parse(*resource);
  if (!nets.ok()) return nets.error();
  return std::make_unique<NeuroFuzzy>(*nets, parameters.target, *infrareds);
}

domain::Motion NeuroFuzzy::step(const domain::Odometry& odometry, const domain::Scan& scan,
                                const core::Vec2& target_odom) {
  const double target_rad = core::bearing_rad(odometry.pose_odom_robot, target_odom);
  return to_motion(nets_.speeds(infrareds_.readings(scan)) +
                   target_term(target_, target_rad, infrareds_.distances_m(scan)));
}

}  // namespace clew::control

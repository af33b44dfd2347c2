// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/angle.hpp"
#include "core/result.hpp"
#include "sense/range_noise.hpp"
#include "sense/range_sensor.hpp"

namespace clew::sense {

struct SonarRingParameters {
  double range_m = 2.54;
  double cone_rad = core::radians(22.5);
  std::int64_t sonars = 16;
  RangeNoiseParameters noise;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, SonarRingParameters& p) {
  visit.number("range_m", p.range_m, "m", {0.1, 20.0},
               "how far a sonar sees, from the robot's skin");
  visit.angle("cone_deg", p.cone_rad, {1.0, 90.0}, "full opening of a sonar's cone");
  visit.integer("sonars", p.sonars, "1", {3, 64}, "number of sonars on the ring, at equal angles");
  visit_parameters(visit, p.noise);
}

/// A ring of sonars all around the robot: the 16 of the Nomad 200 with the scope of 100 inches
/// (2.54 m) of Lagoudakis & Maida 1999, Results. Sonar 0 looks straight back, the next ones go
/// clockwise, over the left to the front. A reading is the least distance to anything inside the
/// cone. The paper gives no opening: ours is the one at which 16 cones lie side by side.
class SonarRing final : public RangeSensor {
 public:
  using Parameters = SonarRingParameters;

  static core::Result<std::unique_ptr<SonarRing>> create(const Parameters& parameters,
                                                         const domain::BehaviourSetup& setup);

  SonarRing(const Parameters& parameters, double radius_m);

  domain::ScanLayout layout() const override;
  void measure(const world::World& world, const core::Pose2& pose_world_robot, double sim_time_s,
               const core::Random& random, domain::Scan& scan) const override;
  void tell(const Sweep& sweep, domain::Inside& inside) const override;

 private:
  double bearing_step_rad() const { return -2.0 * core::kPi / static_cast<double>(cones_.size()); }

  Parameters parameters_;
  double radius_m_;
  std::vector<world::ConeDirection> cones_;  // in the robot's frame
};

}  // namespace clew::sense

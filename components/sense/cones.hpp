// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>

#include "core/angle.hpp"
#include "core/result.hpp"
#include "sense/range_noise.hpp"
#include "sense/range_sensor.hpp"

namespace clew::sense {

struct ConesParameters {
  double range_m = 1.5;
  double corner_echo_ratio = 0.0;
  RangeNoiseParameters noise;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, ConesParameters& p) {
  visit.number("range_m", p.range_m, "m", {0.1, 20.0},
               "how far a cone sees, from the robot's skin");
  visit.number("corner_echo_ratio", p.corner_echo_ratio, "1", {0.0, 2.0},
               "how much multiple reflection in a corner lengthens a reading; 0 is off");
  visit_parameters(visit, p.noise);
}

/// Seven ultrasonic cones of 15 degrees, side by side over the front 105 degrees: Krishna & Kalra
/// 2000, sections 2 and 4. Cone i is centred at 45 - 15 i degrees from the heading, so cone 0 is
/// leftmost. A reading is the least distance to anything inside the cone, exact for the clipped
/// geometry, from the robot's skin: apex at the centre, radius taken off, clipped to [0, range_m].
///
/// Multiple reflection (section 4.6) is not modelled in the paper. Ours: where a cone looks into an
/// inner corner, and the walls of that corner are the nearest thing in it, the pulse comes back by
/// way of both walls; the reading is the distance to the corner times 1 + corner_echo_ratio.
class Cones final : public RangeSensor {
 public:
  using Parameters = ConesParameters;
  static constexpr std::size_t kCount = 7;

  static core::Result<std::unique_ptr<Cones>> create(const Parameters& parameters,
                                                     const domain::BehaviourSetup& setup);

  Cones(const Parameters& parameters, double radius_m);

  domain::ScanLayout layout() const override;
  void measure(const world::World& world, const core::Pose2& pose_world_robot, double sim_time_s,
               const core::Random& random, domain::Scan& scan) const override;
  void tell(const Sweep& sweep, domain::Inside& inside) const override;

 private:
  double echo_m(const world::World& world, const core::Pose2& pose_world_robot,
                const core::Vec2& heading, double sim_time_s, std::size_t i) const;

  Parameters parameters_;
  double radius_m_;
  std::array<world::ConeDirection, kCount> cones_;  // in the robot's frame
};

}  // namespace clew::sense

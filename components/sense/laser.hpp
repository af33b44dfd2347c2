// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "core/angle.hpp"
#include "core/result.hpp"
#include "sense/range_noise.hpp"
#include "sense/range_sensor.hpp"
#include "world/ray_fan.hpp"

namespace clew::sense {

struct LaserParameters {
  double range_m = 2.0;
  double field_rad = core::radians(180.0);
  std::int64_t beams = 361;
  RangeNoiseParameters noise;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, LaserParameters& p) {
  visit.number("range_m", p.range_m, "m", {0.1, 100.0}, "how far it sees, from the robot's skin");
  visit.angle("field_deg", p.field_rad, {1.0, 360.0}, "field of view, half of it on each side");
  visit.integer("beams", p.beams, "1", {2, static_cast<double>(domain::kMaxRanges)},
                "number of rays over the field, one at each end");
  visit_parameters(visit, p.noise);
}

/// A laser range finder: rays at equal angles over the field, ray 0 leftmost, as Nakhaeinia et al.
/// 2015, section III, give it (2 m). The paper does not give the field: ours is the 180 degrees in
/// half degrees of the scanners of its time. A field of 360 degrees ends where it began, behind the
/// robot.
class Laser final : public RangeSensor {
 public:
  using Parameters = LaserParameters;

  static core::Result<std::unique_ptr<Laser>> create(const Parameters& parameters,
                                                     const domain::BehaviourSetup& setup);

  Laser(const Parameters& parameters, double radius_m);

  domain::ScanLayout layout() const override;
  void measure(const world::World& world, const core::Pose2& pose_world_robot, double sim_time_s,
               const core::Random& random, domain::Scan& scan) const override;
  void tell(const Sweep& sweep, domain::Inside& inside) const override;

 private:
  Parameters parameters_;
  double radius_m_;
  world::RayFan fan_;
};

}  // namespace clew::sense

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "core/result.hpp"
#include "sense/range_noise.hpp"
#include "sense/range_sensor.hpp"
#include "world/ray_fan.hpp"

namespace clew::sense {

struct InfraredParameters {
  double range_min_m = 0.10;
  double range_m = 0.80;
  domain::InfraredCurve curve;
  RangeNoiseParameters noise;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, InfraredParameters& p) {
  visit.number("range_min_m", p.range_min_m, "m", {0.01, 0.5},
               "least distance that it can measure; a smaller one reads as this");
  visit.number("range_m", p.range_m, "m", {0.51, 5.0}, "how far it sees, from the robot's skin");
  visit.number("curve_gain_m", p.curve.gain_m, "m", {0.1, 100.0},
               "K_g of the curve S = K_o + K_g / distance");
  visit.number("curve_offset", p.curve.offset, "1", {0.0, 200.0},
               "K_o of the curve: the answer if nothing is in range");
  visit_parameters(visit, p.noise);
}

/// Four infrared rangers, one on each side of the robot, each a ray: Wang, Yang & Meng, section II
/// (Sharp GP2D02, 0.10 to 0.80 m, 8 bits). Beam 0 looks left, 1 ahead, 2 right, 3 back; the paper's
/// I_1 .. I_4 are ahead, back, left, right.
///
/// The scan carries the metres that the 8 bits of domain::InfraredCurve stand for, d' = K_g / ((255
/// - I) - K_o), so every consumer of scans can use it; the layout carries the curve, which gives a
/// controller I back: near 0.8 m a unit of I is 4 cm.
///
/// *Deviation:* below range_min_m the real answer falls again; here it stays that of range_min_m.
class Infrared final : public RangeSensor {
 public:
  using Parameters = InfraredParameters;
  static constexpr std::size_t kCount = 4;

  static core::Result<std::unique_ptr<Infrared>> create(const Parameters& parameters,
                                                        const domain::BehaviourSetup& setup);

  Infrared(const Parameters& parameters, double radius_m);

  domain::ScanLayout layout() const override;
  void measure(const world::World& world, const core::Pose2& pose_world_robot, double sim_time_s,
               const core::Random& random, domain::Scan& scan) const override;
  void tell(const Sweep& sweep, domain::Inside& inside) const override;

  /// The distance that a reading stands for, in [range_min_m, range_m].
  double distance_m(double reading) const;

 private:
  Parameters parameters_;
  double radius_m_;
  world::RayFan fan_;
};

}  // namespace clew::sense

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
  double curve_gain_m = 15.467;
  double curve_offset = 55.67;
  RangeNoiseParameters noise;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, InfraredParameters& p) {
  visit.number("range_min_m", p.range_min_m, "m", {0.01, 0.5}, "below this it cannot measure");
  visit.number("range_m", p.range_m, "m", {0.51, 5.0}, "how far it sees, from the robot's skin");
  visit.number("curve_gain_m", p.curve_gain_m, "m", {0.1, 100.0},
               "K_g of the curve S = K_o + K_g / distance");
  visit.number("curve_offset", p.curve_offset, "1", {0.0, 200.0},
               "K_o: what the sensor says of nothing");
  visit_parameters(visit, p.noise);
}

/// Four infrared rangers, one on each side of the robot, each a ray: Wang, Yang & Meng, section II
/// (Sharp GP2D02, 0.10 to 0.80 m, 8 bits). Beam 0 looks left, 1 ahead, 2 right, 3 back; the paper's
/// I_1 .. I_4 are ahead, back, left, right.
///
/// The sensor's answer is S = K_o + K_g / d, rounded to 8 bits; the paper reads I = 255 - S (eq.
/// 2). The curve is its figure's, which is lost: K_o and K_g are those at which S falls by 58 from
/// 0.2 to 0.8 m, to 75, the typical values of the maker's data sheet. The scan carries the metres
/// that the quantised answer stands for, d' = K_g / ((255 - I) - K_o), so every consumer of scans
/// can use it, and reading() gives a controller I back: near 0.8 m a unit of I is 4 cm.
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

  /// I of eq. 2 for a distance from the skin: a whole number, 0..255, that rises with distance.
  double reading(double distance_m) const;
  /// The distance that a reading stands for, in [range_min_m, range_m].
  double distance_m(double reading) const;

 private:
  Parameters parameters_;
  double radius_m_;
  world::RayFan fan_;
};

}  // namespace clew::sense

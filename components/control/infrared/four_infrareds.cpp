// SPDX-License-Identifier: Apache-2.0
#include "control/infrared/four_infrareds.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "core/angle.hpp"

namespace clew::control {
namespace {

constexpr std::array<double, 4> kBearings_rad = {0.0, core::radians(180.0), core::radians(90.0),
                                                 core::radians(-90.0)};  // by InfraredSide

std::optional<std::size_t> beam_at(const domain::ScanLayout& layout, double bearing_rad) {
  constexpr double kTolerance_rad = core::radians(1.0);
  for (std::size_t i = 0; i < layout.beam_count; ++i) {
    const double beam_rad =
        layout.bearing_first_rad + static_cast<double>(i) * layout.bearing_step_rad;
    if (std::fabs(core::wrap_angle_rad(beam_rad - bearing_rad)) < kTolerance_rad) return i;
  }
  return std::nullopt;
}

}  // namespace

core::Result<FourInfrareds> FourInfrareds::create(const domain::ScanLayout& layout,
                                                  const std::string& behaviour) {
  std::array<std::size_t, 4> beams{};
  bool fits = layout.beam_count == beams.size() && layout.infrared_curve.has_value();
  for (std::size_t side = 0; side < beams.size() && fits; ++side) {
    const auto beam = beam_at(layout, kBearings_rad[side]);
    fits = beam.has_value();
    if (fits) beams[side] = *beam;
  }
  if (fits) return FourInfrareds(*layout.infrared_curve, beams);
  return core::Error{
      fmt::format("{} needs four infrared rays, ahead, back, left and right; '{}' gives {} {}, "
                  "from {:.4g} degrees in steps of {:.4g}",
                  behaviour, layout.sensor, layout.beam_count,
                  layout.infrared_curve ? "infrared rays" : "beams that are no infrared",
                  core::degrees(layout.bearing_first_rad), core::degrees(layout.bearing_step_rad))};
}

InfraredReadings FourInfrareds::readings(const domain::Scan& scan) const {
  InfraredReadings readings{};
  for (std::size_t side = 0; side < beams_.size(); ++side) {
    readings[side] = curve_.reading(scan.ranges_m[beams_[side]]);
  }
  return readings;
}

InfraredDistances FourInfrareds::distances_m(const domain::Scan& scan) const {
  InfraredDistances distances{};
  for (std::size_t side = 0; side < beams_.size(); ++side) {
    distances[side] = scan.ranges_m[beams_[side]];
  }
  return distances;
}

}  // namespace clew::control

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "core/result.hpp"
#include "domain/setup.hpp"

namespace clew::control {

/// The readings I_1 .. I_4 of Wang, Yang & Meng, section II, each 0..255, out of a scan.
using InfraredReadings = std::array<double, 4>;

/// Places in arrays of four, in the paper's order.
enum InfraredSide : std::size_t { kAhead, kBack, kLeft, kRight };

/// Distances from the skin, in the same order.
using InfraredDistances = std::array<double, 4>;

/// The least distance that the sensors can tell.
inline constexpr double kNearestReading_m = 0.1;

/// Finds the paper's four infrared rangers among a scan's beams.
class FourInfrareds {
 public:
  /// Fails unless the layout has four rays, ahead, back, left and right, with an infrared curve.
  /// `behaviour` names the caller in the error.
  static core::Result<FourInfrareds> create(const domain::ScanLayout& layout,
                                            const std::string& behaviour);

  /// What the sensors answered: the 8 bits that the scan's metres stand for.
  InfraredReadings readings(const domain::Scan& scan) const;
  InfraredDistances distances_m(const domain::Scan& scan) const;

 private:
  FourInfrareds(const domain::InfraredCurve& curve, const std::array<std::size_t, 4>& beams)
      : curve_(curve), beams_(beams) {}

  domain::InfraredCurve curve_;
  std::array<std::size_t, 4> beams_;  ///< by InfraredSide
};

}  // namespace clew::control

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "core/angle.hpp"
#include "core/result.hpp"
#include "domain/setup.hpp"

namespace clew::scan {

/// Seven sectors of 15 degrees, from 45 degrees on the left to 45 on the right: what Krishna &
/// Kalra's rules see. Other sensors serve them if they see each of the sectors.
class SevenCones {
 public:
  static constexpr std::size_t kCount = 7;
  static constexpr double kWidth_rad = core::radians(15.0);

  /// Fails if a sector of the layout has no beam. `behaviour` names the caller in the error.
  static core::Result<void> check(const domain::ScanLayout& layout, const std::string& behaviour);

  /// Whether a sensor's beams are these cones themselves, to within 0.1 degrees.
  static bool are(const domain::ScanLayout& layout);

  /// Sees `range_m` far, or less if the sensor does.
  explicit SevenCones(double range_m) : range_m_(range_m) {}

  /// The least reading of each sector, of the beams that reach into it: the same readings for a
  /// scan that is of seven cones. Valid until the next call.
  const domain::Scan& see(const domain::Scan& scan);

 private:
  double range_m_;
  domain::Scan cones_;
};

}  // namespace clew::scan

// SPDX-License-Identifier: Apache-2.0
#include "scan/scan_check.hpp"

#include <algorithm>

#include "core/angle.hpp"
#include "domain/field_check.hpp"

namespace clew::scan {
namespace {

constexpr double kBearingTolerance_rad = core::radians(0.1);
constexpr double kRangeTolerance_m = 0.001;

}  // namespace

core::Result<void> check_arrangement(const domain::Scan& scan, const domain::ScanLayout& declared) {
  if (declared.sensor.empty()) return {};
  domain::FieldCheck check(domain::Topic::kScan);
  const auto near = [&](const char* field, double value, double wanted, double tolerance) {
    check.in_range({field}, value, wanted - tolerance, wanted + tolerance);
  };
  check.size_is({"ranges_m"}, scan.ranges_m.size(), declared.beam_count);
  near("bearing_first_rad", scan.bearing_first_rad, declared.bearing_first_rad,
       kBearingTolerance_rad);
  // What a step is off adds up to the last beam.
  const double steps = std::max(1.0, static_cast<double>(declared.beam_count) - 1.0);
  near("bearing_step_rad", scan.bearing_step_rad, declared.bearing_step_rad,
       kBearingTolerance_rad / steps);
  near("beam_width_rad", scan.beam_width_rad, declared.beam_width_rad, kBearingTolerance_rad);
  near("range_max_m", scan.range_max_m, declared.range_max_m, kRangeTolerance_m);
  const auto result = check.result();
  if (result.ok()) return result;
  return core::Error{result.error().message + ", as sense " + declared.sensor + " has"};
}

}  // namespace clew::scan

// SPDX-License-Identifier: Apache-2.0
#include "sense/range_noise.hpp"

#include <algorithm>
#include <cmath>

namespace clew::sense {
namespace {

constexpr std::uint32_t kNumbersAReading = 3;

double spoiled_m(const RangeNoiseParameters& parameters, const core::Random& random,
                 std::uint32_t first, const domain::Scan& scan, double range_m) {
  const double fate = parameters.drop_out_ratio > 0.0 || parameters.outlier_ratio > 0.0
                          ? random.uniform(first + 1)
                          : 1.0;
  if (fate < parameters.drop_out_ratio) return scan.range_max_m;
  if (fate < parameters.drop_out_ratio + parameters.outlier_ratio) {
    return scan.range_min_m + (scan.range_max_m - scan.range_min_m) * random.uniform(first + 2);
  }
  if (parameters.stddev_m > 0.0 && range_m < scan.range_max_m) {
    return range_m + parameters.stddev_m * random.normal(first);
  }
  return range_m;
}

}  // namespace

void add_range_noise(const RangeNoiseParameters& parameters, const core::Random& random,
                     domain::Scan& scan) {
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const auto first = kNumbersAReading * static_cast<std::uint32_t>(i);
    double range_m = spoiled_m(parameters, random, first, scan, scan.ranges_m[i]);
    if (parameters.resolution_m > 0.0) {
      range_m = parameters.resolution_m * std::floor(range_m / parameters.resolution_m + 0.5);
    }
    scan.ranges_m[i] = std::clamp(range_m, scan.range_min_m, scan.range_max_m);
  }
}

}  // namespace clew::sense

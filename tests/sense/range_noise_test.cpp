// SPDX-License-Identifier: Apache-2.0
#include "sense/range_noise.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace clew::sense {
namespace {

constexpr std::size_t kReadings = 2000;
constexpr double kTrue_m = 1.0;

/// A scan of kReadings readings of 1 m, of a sensor of 0.1 to 2 m, after the noise.
std::vector<double> spoiled(const RangeNoiseParameters& parameters, std::uint64_t tick = 0,
                            double true_m = kTrue_m) {
  domain::Scan scan;
  scan.range_min_m = 0.1;
  scan.range_max_m = 2.0;
  scan.ranges_m.assign(kReadings, true_m);
  add_range_noise(parameters, core::Random({1, 0, 1, tick}), scan);
  return scan.ranges_m;
}

double share(const std::vector<double>& ranges_m, double value_m) {
  return static_cast<double>(std::count(ranges_m.begin(), ranges_m.end(), value_m)) / kReadings;
}

TEST(RangeNoise, LeavesReadingsAloneByDefault) {
  EXPECT_EQ(spoiled({}), std::vector<double>(kReadings, kTrue_m));
}

TEST(RangeNoise, IsAFunctionOfTheTick) {
  const RangeNoiseParameters noisy{0.02, 0.1, 0.1, 0.0};

  EXPECT_EQ(spoiled(noisy, 7), spoiled(noisy, 7));
  EXPECT_NE(spoiled(noisy, 7), spoiled(noisy, 8));
}

TEST(RangeNoise, HasTheStandardDeviationAskedFor) {
  double sum_m = 0.0;
  double squares_m2 = 0.0;
  for (const double range_m : spoiled({0.05, 0.0, 0.0, 0.0})) {
    sum_m += range_m - kTrue_m;
    squares_m2 += (range_m - kTrue_m) * (range_m - kTrue_m);
  }

  // Five standard errors: 0.05 / sqrt(2000) of the mean, 0.05 / sqrt(4000) of the deviation.
  EXPECT_NEAR(sum_m / kReadings, 0.0, 0.0056);
  EXPECT_NEAR(std::sqrt(squares_m2 / kReadings), 0.05, 0.004);
}

TEST(RangeNoise, DoesNotErrWhereNothingReturned) {
  EXPECT_EQ(spoiled({0.05, 0.0, 0.0, 0.0}, 0, 2.0), std::vector<double>(kReadings, 2.0));
}

TEST(RangeNoise, LosesTheShareOfReadingsAskedFor) {
  // Five standard errors of a share of 0.25 of 2000: 0.048.
  EXPECT_NEAR(share(spoiled({0.0, 0.0, 0.25, 0.0}), 2.0), 0.25, 0.048);
}

TEST(RangeNoise, MakesTheShareOfOutliersAskedForUniformWithinRange) {
  const std::vector<double> ranges_m = spoiled({0.0, 0.25, 0.0, 0.0});

  double sum_m = 0.0;
  for (const double range_m : ranges_m) {
    if (range_m != kTrue_m) sum_m += range_m;
  }
  const double outlier_ratio = 1.0 - share(ranges_m, kTrue_m);
  EXPECT_NEAR(outlier_ratio, 0.25, 0.048);
  // Uniform in [0.1, 2]: mean 1.05, deviation 1.9 / sqrt(12) = 0.55; five errors of 500 numbers.
  EXPECT_NEAR(sum_m / (outlier_ratio * kReadings), 1.05, 0.13);
}

TEST(RangeNoise, RoundsToTheResolution) {
  // 1.03 m to multiples of 0.05 m.
  EXPECT_NEAR(spoiled({0.0, 0.0, 0.0, 0.05}, 0, 1.03)[0], 1.05, 1e-12);
  EXPECT_NEAR(spoiled({0.0, 0.0, 0.0, 0.05}, 0, 1.02)[0], 1.00, 1e-12);
}

TEST(RangeNoise, KeepsReadingsWithinRange) {
  const std::vector<double> ranges_m = spoiled({1.0, 0.0, 0.0, 0.3});

  EXPECT_EQ(*std::min_element(ranges_m.begin(), ranges_m.end()), 0.1);
  EXPECT_EQ(*std::max_element(ranges_m.begin(), ranges_m.end()), 2.0);
}

TEST(RangeNoise, DoesNotShiftNumbersWhenAnOptionIsAdded) {
  const std::vector<double> plain = spoiled({0.02, 0.0, 0.0, 0.0});
  const std::vector<double> lossy = spoiled({0.02, 0.0, 0.5, 0.0});

  for (std::size_t i = 0; i < kReadings; ++i) {
    EXPECT_TRUE(lossy[i] == plain[i] || lossy[i] == 2.0) << i;
  }
}

}  // namespace
}  // namespace clew::sense

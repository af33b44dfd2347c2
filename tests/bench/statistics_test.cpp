// SPDX-License-Identifier: Apache-2.0
#include "bench/statistics.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "core/random.hpp"

namespace clew::bench {
namespace {

TEST(WilsonInterval, HasThePublishedValues) {
  const Interval eight_of_ten = wilson_interval(8, 10);
  const Interval none_of_ten = wilson_interval(0, 10);
  const Interval all_of_ten = wilson_interval(10, 10);

  // (p + z^2 / 2n +- z sqrt(p (1 - p) / n + z^2 / 4n^2)) / (1 + z^2 / n), z = 1.95996
  EXPECT_NEAR(eight_of_ten.low, 0.4902, 1e-4);
  EXPECT_NEAR(eight_of_ten.high, 0.9433, 1e-4);
  EXPECT_EQ(none_of_ten.low, 0.0);
  EXPECT_NEAR(none_of_ten.high, 0.2775, 1e-4);
  EXPECT_NEAR(all_of_ten.low, 0.7225, 1e-4);
  EXPECT_EQ(all_of_ten.high, 1.0);
}

TEST(WilsonInterval, KnowsNothingWithoutTrials) {
  const Interval interval = wilson_interval(0, 0);

  EXPECT_EQ(interval.low, 0.0);
  EXPECT_EQ(interval.high, 1.0);
}

TEST(Quantile, IsLinearBetweenTheNearest) {
  const std::vector<double> values = {4.0, 1.0, 3.0, 2.0};

  EXPECT_DOUBLE_EQ(quantile(values, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(quantile(values, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(quantile(values, 0.9), 3.7);  // place 2.7 of 0..3
  EXPECT_DOUBLE_EQ(quantile(values, 1.0), 4.0);
  EXPECT_DOUBLE_EQ(quantile({7.0}, 0.9), 7.0);
}

TEST(McNemar, IsTheBinomialTestOfTheUnequalPairs) {
  // 2 (C(10, 0) + C(10, 1)) / 2^10
  EXPECT_NEAR(mcnemar_p(1, 9), 22.0 / 1024.0, 1e-12);
  EXPECT_NEAR(mcnemar_p(9, 1), 22.0 / 1024.0, 1e-12);
  EXPECT_NEAR(mcnemar_p(0, 12), 2.0 / 4096.0, 1e-12);
  EXPECT_EQ(mcnemar_p(5, 5), 1.0);
  EXPECT_EQ(mcnemar_p(0, 0), 1.0);
}

TEST(McNemar, HoldsForThousandsOfPairs) {
  // The normal approximation of 2 P(X <= 2400), X ~ B(5000, 1/2): z = (2400.5 - 2500) / 35.355.
  EXPECT_NEAR(mcnemar_p(2400, 2600), 0.004889, 1e-4);
}

TEST(QuantileInterval, IsOfOrderStatistics) {
  // Of 10 values ranks 2 and 9: 2 P(X <= 1) = 22 / 1024 is below 5 %, 2 P(X <= 2) = 112 / 1024 not.
  const auto interval = quantile_interval({10, 9, 8, 7, 6, 5, 4, 3, 2, 1}, 0.5);

  ASSERT_TRUE(interval.has_value());
  EXPECT_EQ(interval->low, 2.0);
  EXPECT_EQ(interval->high, 9.0);
}

TEST(QuantileInterval, OfTheMedianNeedsSixValues) {
  // With 5 values even the whole range covers the median with 1 - 2 / 32 only.
  EXPECT_FALSE(quantile_interval({1, 2, 3, 4, 5}, 0.5).has_value());

  const auto of_six = quantile_interval({1, 2, 3, 4, 5, 6}, 0.5);
  ASSERT_TRUE(of_six.has_value());
  EXPECT_EQ(of_six->low, 1.0);
  EXPECT_EQ(of_six->high, 6.0);
}

TEST(QuantileInterval, OfAHighQuantileNeedsEnoughValuesAboveIt) {
  // The greatest of n values is below the 90 % quantile with 0.9^n: 2.6 % of 35, 2.3 % of 36.
  std::vector<double> values(35);
  std::iota(values.begin(), values.end(), 1.0);
  EXPECT_FALSE(quantile_interval(values, 0.9).has_value());

  values.push_back(36.0);
  const auto interval = quantile_interval(values, 0.9);
  ASSERT_TRUE(interval.has_value());
  EXPECT_EQ(interval->high, 36.0);
  // P(X <= 28) = 2.35 % and P(X <= 29) = 6.3 % of 36 with 0.9.
  EXPECT_EQ(interval->low, 29.0);
}

TEST(QuantileInterval, CoversTheQuantileAsOftenAsItSays) {
  // Of 400 samples of 100 uniform values, 380 are to hold 0.9; three deviations fewer are 367.
  int covered = 0;
  for (std::uint64_t sample = 0; sample < 400; ++sample) {
    const core::Random random(core::RandomKey{7, 0, 0, sample});
    std::vector<double> values;
    for (std::uint32_t i = 0; i < 100; ++i) values.push_back(random.uniform(i));
    const auto interval = quantile_interval(values, 0.9);
    ASSERT_TRUE(interval.has_value());
    covered += interval->low <= 0.9 && 0.9 <= interval->high ? 1 : 0;
  }
  EXPECT_GE(covered, 367);
}

TEST(MeanInterval, HoldsTheMeanAndNarrowsWithMoreValues) {
  const auto of_uniform = [](std::uint32_t count) {
    const core::Random random(core::RandomKey{3, 0, 0, 0});
    std::vector<double> values;
    for (std::uint32_t i = 0; i < count; ++i) values.push_back(random.uniform(i));
    return mean_interval(values).value();
  };

  const Interval of_many = of_uniform(400);

  // 2 * 1.96 / sqrt(12 * 400) = 0.0566 wide by the normal approximation.
  EXPECT_NEAR(of_many.high - of_many.low, 0.0566, 0.006);
  EXPECT_LT(of_many.low, 0.5);
  EXPECT_GT(of_many.high, 0.5);
  EXPECT_GT(of_uniform(25).high - of_uniform(25).low, 3.0 * (of_many.high - of_many.low));
  EXPECT_FALSE(mean_interval({1, 2, 3, 4, 5}).has_value());
}

TEST(MeanInterval, OfEqualValuesIsTheirMean) {
  const std::vector<double> values(8, 2.0);

  EXPECT_EQ(mean(values), 2.0);
  EXPECT_EQ(mean_interval(values)->low, 2.0);
  EXPECT_EQ(mean_interval(values)->high, 2.0);
}

}  // namespace
}  // namespace clew::bench

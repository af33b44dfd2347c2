// SPDX-License-Identifier: Apache-2.0
#include "bench/statistics.hpp"

#include <gtest/gtest.h>

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

TEST(MedianInterval, IsOfOrderStatistics) {
  // Of 10 values ranks 2 and 9: 2 P(X <= 1) = 22 / 1024 is below 5 %, 2 P(X <= 2) = 112 / 1024 not.
  const auto interval = median_interval({10, 9, 8, 7, 6, 5, 4, 3, 2, 1});

  ASSERT_TRUE(interval.has_value());
  EXPECT_EQ(interval->low, 2.0);
  EXPECT_EQ(interval->high, 9.0);
}

TEST(MedianInterval, NeedsSixValues) {
  // With 5 values even the whole range covers the median with 1 - 2 / 32 only.
  EXPECT_FALSE(median_interval({1, 2, 3, 4, 5}).has_value());

  const auto of_six = median_interval({1, 2, 3, 4, 5, 6});
  ASSERT_TRUE(of_six.has_value());
  EXPECT_EQ(of_six->low, 1.0);
  EXPECT_EQ(of_six->high, 6.0);
}

}  // namespace
}  // namespace clew::bench

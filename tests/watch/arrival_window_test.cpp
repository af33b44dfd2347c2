// SPDX-License-Identifier: Apache-2.0
#include "watch/arrival_window.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace clew::bridge {
namespace {

TEST(NumberWindow, TellsMeanEndsAndDeviationOfTheLastNumbers) {
  NumberWindow window(4);
  EXPECT_FALSE(window.spread().has_value());

  // 100 falls out of the window.
  for (const double number : {100.0, 2.0, 4.0, 4.0, 6.0}) window.add(number);

  const auto spread = window.spread();
  ASSERT_TRUE(spread.has_value());
  EXPECT_EQ(spread->count, 4U);
  EXPECT_DOUBLE_EQ(spread->mean, 4.0);
  EXPECT_DOUBLE_EQ(spread->min, 2.0);
  EXPECT_DOUBLE_EQ(spread->max, 6.0);
  // The squares of -2, 0, 0 and 2 are 8 together, 2 in the mean.
  EXPECT_DOUBLE_EQ(spread->stddev, std::sqrt(2.0));
}

TEST(ArrivalWindow, HasNoRateBeforeTwoSamplesAtDifferentTimes) {
  ArrivalWindow window(10);
  window.add(1.0, 8, 0);
  window.add(1.0, 8, 1);

  EXPECT_FALSE(window.rate_hz().has_value());
  EXPECT_FALSE(window.bytes_per_s().has_value());
}

TEST(ArrivalWindow, TellsTheWritersRateAlthoughSamplesAreLost) {
  ArrivalWindow window(10);
  // Ten samples a second, of which two did not arrive.
  window.add(0.0, 20, 0);
  window.add(0.1, 20, 1);
  window.add(0.4, 40, 4);
  window.add(0.5, 40, 5);

  EXPECT_DOUBLE_EQ(*window.rate_hz(), 10.0);
  EXPECT_EQ(window.lost(), 2U);
  EXPECT_DOUBLE_EQ(window.sizes_bytes()->mean, 30.0);
  EXPECT_DOUBLE_EQ(*window.bytes_per_s(), 300.0);
  EXPECT_NEAR(window.intervals_s()->max, 0.3, 1e-12);
}

TEST(ArrivalWindow, TakesAWriterThatWasSetBackForNoLoss) {
  ArrivalWindow window(10);
  for (const std::uint64_t sequence : {7U, 8U, 3U, 4U}) {
    window.add(static_cast<double>(window.count()), 1, sequence);
  }

  EXPECT_EQ(window.lost(), 0U);
  EXPECT_DOUBLE_EQ(*window.rate_hz(), 1.0);
}

TEST(ArrivalWindow, KeepsTheLastSamplesOnly) {
  ArrivalWindow window(2);
  window.add(0.0, 1, std::nullopt);
  window.add(10.0, 1, std::nullopt);
  window.add(10.5, 1, std::nullopt);

  EXPECT_EQ(window.count(), 2U);
  EXPECT_DOUBLE_EQ(*window.rate_hz(), 2.0);
}

}  // namespace
}  // namespace clew::bridge

// SPDX-License-Identifier: Apache-2.0
#include "core/random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace clew::core {
namespace {

using Words = std::array<std::uint32_t, 4>;

// The known answers that come with the generator: Random123, tests/kat_vectors, philox4x32 10.
constexpr std::uint32_t kOnes = 0xffffffff;

TEST(Philox, GivesThePublishedNumbers) {
  EXPECT_EQ(philox4x32({0, 0, 0, 0}, {0, 0}),
            (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(philox4x32({kOnes, kOnes, kOnes, kOnes}, {kOnes, kOnes}),
            (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox4x32({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Random, LaysItsKeyOutInThePublishedOrder) {
  // The third published vector: tick in words 0 and 1 of the counter, index in word 2, component in
  // word 3, seed in the key; the first two words of the answer are the bits.
  const Random random({0x299f31d0a4093822, 0, 0x03707344, 0x85a308d3243f6a88});

  EXPECT_EQ(random.bits(0x13198a2e), 0x94fdccebd16cfe09u);
}

TEST(Random, EveryPartOfTheKeyCounts) {
  const RandomKey key{1, 0, 0, 0};
  std::set<std::uint64_t> seen;

  seen.insert(Random(key).bits(0));
  seen.insert(Random(key).bits(1));
  seen.insert(Random({2, 0, 0, 0}).bits(0));
  seen.insert(Random({1ull << 32, 0, 0, 0}).bits(0));
  seen.insert(Random({1, 1, 0, 0}).bits(0));
  seen.insert(Random({1, 0, 1, 0}).bits(0));
  seen.insert(Random({1, 0, 0, 1}).bits(0));
  seen.insert(Random({1, 0, 0, 1ull << 32}).bits(0));

  EXPECT_EQ(seen.size(), 8u);
}

TEST(Random, IsAFunctionOfKeyAndIndexAlone) {
  const Random random({7, 1, 2, 3});
  const std::uint64_t first = random.bits(5);

  static_cast<void>(random.bits(6));

  EXPECT_EQ(random.bits(5), first);
  EXPECT_EQ(Random({7, 1, 2, 3}).bits(5), first);
}

constexpr std::uint32_t kSamples = 100000;

/// Mean of f over the samples.
template <typename F>
double mean_of(F f) {
  double sum = 0.0;
  for (std::uint32_t i = 0; i < kSamples; ++i) sum += f(i);
  return sum / kSamples;
}

// Means of N samples scatter by their standard deviation / sqrt(N): five of these are allowed.
double allowed(double variance) { return 5.0 * std::sqrt(variance / kSamples); }

TEST(Random, UniformNumbersHaveTheMomentsOfTheirDistribution) {
  const Random random({});

  const double mean = mean_of([&](std::uint32_t i) { return random.uniform(i); });
  const double square = mean_of([&](std::uint32_t i) { return std::pow(random.uniform(i), 2); });
  const double neighbours =
      mean_of([&](std::uint32_t i) { return random.uniform(i) * random.uniform(i + 1); });

  // E u = 1/2, var u = 1/12; E u^2 = 1/3, var u^2 = 1/5 - 1/9; E uv = 1/4, var uv = 1/9 - 1/16.
  EXPECT_NEAR(mean, 1.0 / 2.0, allowed(1.0 / 12.0));
  EXPECT_NEAR(square, 1.0 / 3.0, allowed(1.0 / 5.0 - 1.0 / 9.0));
  EXPECT_NEAR(neighbours, 1.0 / 4.0, allowed(1.0 / 9.0 - 1.0 / 16.0));
}

TEST(Random, UniformNumbersAreBelowOne) {
  const Random random({});
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    const double u = random.uniform(i);

    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    ASSERT_EQ(u * 0x1p53, std::floor(u * 0x1p53));
  }
}

TEST(Random, NormalNumbersHaveTheMomentsOfTheirDistribution) {
  const Random random({});
  const auto moment = [&](int power) {
    return mean_of([&](std::uint32_t i) { return std::pow(random.normal(i), power); });
  };

  // E n^k = 0, 1, 0, 3 for k = 1..4, and var n^k = E n^2k - (E n^k)^2 = 1, 2, 15, 96.
  EXPECT_NEAR(moment(1), 0.0, allowed(1.0));
  EXPECT_NEAR(moment(2), 1.0, allowed(2.0));
  EXPECT_NEAR(moment(3), 0.0, allowed(15.0));
  EXPECT_NEAR(moment(4), 3.0, allowed(96.0));
}

}  // namespace
}  // namespace clew::core

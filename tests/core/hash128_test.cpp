// SPDX-License-Identifier: Apache-2.0
#include "core/hash128.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/archive.hpp"

namespace clew::core {
namespace {

TEST(Hash128, IsXxh3) {
  // Answers of the xxh128sum command of xxHash 0.8.
  EXPECT_EQ(hash128("").hex(), "99aa06d3014798d86001c324468d497f");
  EXPECT_EQ(hash128("a").hex(), "a96faf705af16834e6c632b61e964e1f");
}

TEST(Hash128, PrintsLeadingZeros) {
  EXPECT_EQ((Hash128{0x1, 0xab}).hex(), "000000000000000100000000000000ab");
}

Hash128 chain_of(std::uint64_t tick, std::uint64_t sequence, std::string_view bytes) {
  HashChain chain;
  chain.add(tick, sequence, bytes);
  return chain.value();
}

TEST(HashChain, BeginsAtZero) { EXPECT_EQ(HashChain().value(), Hash128()); }

TEST(HashChain, DependsOnEveryArgument) {
  const Hash128 reference = chain_of(1, 2, "sample");

  EXPECT_EQ(chain_of(1, 2, "sample"), reference);
  EXPECT_NE(chain_of(0, 2, "sample"), reference);
  EXPECT_NE(chain_of(1, 3, "sample"), reference);
  EXPECT_NE(chain_of(2, 1, "sample"), reference);
  EXPECT_NE(chain_of(1, 2, "samplf"), reference);
  EXPECT_NE(chain_of(1, 2, "sampl"), reference);
  EXPECT_NE(chain_of(1, 2, ""), reference);
}

TEST(HashChain, DependsOnTheOrderOfTheSamples) {
  HashChain forward;
  HashChain backward;

  forward.add(0, 0, "a");
  forward.add(0, 0, "b");
  backward.add(0, 0, "b");
  backward.add(0, 0, "a");

  EXPECT_NE(forward.value(), backward.value());
}

TEST(HashChain, DependsOnWhereOneSampleEnds) {
  HashChain early;
  HashChain late;

  early.add(0, 0, "a");
  early.add(0, 0, "bc");
  late.add(0, 0, "ab");
  late.add(0, 0, "c");

  EXPECT_NE(early.value(), late.value());
}

TEST(HashChain, GoesOnFromASavedValue) {
  HashChain whole;
  whole.add(0, 0, "a");
  StateWriter writer;
  Hash128 value = whole.value();
  writer(value);
  whole.add(1, 1, "b");

  StateReader reader(writer.bytes());
  HashChain continued;
  reader(continued);
  continued.add(1, 1, "b");

  EXPECT_TRUE(reader.complete());
  EXPECT_EQ(continued.value(), whole.value());
}

}  // namespace
}  // namespace clew::core

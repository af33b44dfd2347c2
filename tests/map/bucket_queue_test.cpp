// SPDX-License-Identifier: Apache-2.0
#include "map/bucket_queue.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace clew::map {
namespace {

constexpr std::uint32_t kAny = std::numeric_limits<std::uint32_t>::max();
// The first key that no bucket is for.
constexpr std::uint32_t kBeyond = 64U << 16;

TEST(BucketQueue, GivesLowerBucketsFirst) {
  BucketQueue queue;
  queue.clear();
  queue.push({640, 1});
  queue.push({64, 2});
  queue.push({130, 3});

  EXPECT_EQ(queue.take_up_to(kAny)->who, 2U);
  EXPECT_EQ(queue.take_up_to(kAny)->who, 3U);
  EXPECT_EQ(queue.take_up_to(kAny)->who, 1U);
  EXPECT_FALSE(queue.take_up_to(kAny));
}

TEST(BucketQueue, GivesNobodyOfALaterBucket) {
  BucketQueue queue;
  queue.clear();
  queue.push({640, 1});
  queue.push({kBeyond + 640, 2});

  EXPECT_FALSE(queue.take_up_to(639));
  EXPECT_TRUE(queue.take_up_to(640));
  EXPECT_FALSE(queue.take_up_to(kBeyond + 639));
  EXPECT_TRUE(queue.take_up_to(kBeyond + 640));
}

TEST(BucketQueue, KeepsTheOrderBeyondTheLastBucket) {
  BucketQueue queue;
  queue.clear();
  for (const std::uint32_t who : {5U, 2U, 9U, 1U}) queue.push({kBeyond + 1000 * who, who});
  queue.push({7, 0});

  for (const std::uint32_t who : {0U, 1U, 2U, 5U, 9U}) EXPECT_EQ(queue.take_up_to(kAny)->who, who);
}

}  // namespace
}  // namespace clew::map

// SPDX-License-Identifier: Apache-2.0
#include "core/bounded_vector.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace clew::core {
namespace {

TEST(BoundedVector, IsEmptyAtFirst) {
  const BoundedVector<int, 3> list;

  EXPECT_TRUE(list.empty());
  EXPECT_FALSE(list.full());
  EXPECT_EQ(list.begin(), list.end());
}

TEST(BoundedVector, KeepsValuesInOrder) {
  BoundedVector<int, 3> list;
  list.push_back(1);
  list.push_back(20);
  list.push_back(300);

  EXPECT_EQ(list.size(), 3u);
  EXPECT_TRUE(list.full());
  EXPECT_EQ(list[1], 20);
  EXPECT_EQ(std::accumulate(list.begin(), list.end(), 0), 321);
}

TEST(BoundedVector, GrowsByDefaultValues) {
  BoundedVector<int, 3> list;
  list.push_back(7);
  list.push_back(8);
  list.clear();

  list.resize(2);

  EXPECT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0], 0);  // not the 7 that was there
  EXPECT_EQ(list[1], 0);
}

TEST(BoundedVector, ShrinksFromTheEnd) {
  BoundedVector<int, 3> list;
  list.push_back(7);
  list.push_back(8);

  list.resize(1);

  EXPECT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0], 7);
}

TEST(BoundedVector, EqualsWhatHoldsTheSameValues) {
  BoundedVector<int, 3> a;
  BoundedVector<int, 3> b;
  a.push_back(1);
  a.push_back(2);
  b.push_back(1);
  EXPECT_FALSE(a == b);

  a.resize(1);

  EXPECT_TRUE(a == b);  // the 2 that is left in the storage does not count
  b[0] = 3;
  EXPECT_FALSE(a == b);
}

TEST(BoundedVectorDeathTest, HoldsNoMoreThanItsCapacity) {
  BoundedVector<int, 1> list;
  list.push_back(1);

  EXPECT_DEATH(list.push_back(2), "a list of at most 1 values is full");
  EXPECT_DEATH(list.resize(2), "2 values in a list of at most 1");
}

}  // namespace
}  // namespace clew::core

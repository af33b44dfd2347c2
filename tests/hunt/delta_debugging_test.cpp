// SPDX-License-Identifier: Apache-2.0
#include "hunt/delta_debugging.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace clew::hunt {
namespace {

using Items = std::vector<int>;

bool contains(const Items& items, const Items& wanted) {
  return std::all_of(wanted.begin(), wanted.end(), [&](int item) {
    return std::find(items.begin(), items.end(), item) != items.end();
  });
}

Items first_numbers(int count) {
  Items items(static_cast<std::size_t>(count));
  std::iota(items.begin(), items.end(), 0);
  return items;
}

TEST(Minimise, FindsThePartThatEveryFailureHas) {
  for (const Items& culprits : {Items{5}, Items{0, 31}, Items{3, 4, 17}, Items{0, 8, 16, 24, 31}}) {
    const auto left =
        minimise(first_numbers(32), [&](const Items& items) { return contains(items, culprits); });

    EXPECT_EQ(left, culprits);
  }
}

TEST(Minimise, TakesNothingIfNothingIsNeeded) {
  EXPECT_TRUE(minimise(first_numbers(9), [](const Items&) { return true; }).empty());
}

TEST(Minimise, LeavesNoSingleItemThatCanBeMissed) {
  // Any three of the even ones: many minima, each of three.
  const auto fails = [](const Items& items) {
    return std::count_if(items.begin(), items.end(), [](int item) { return item % 2 == 0; }) >= 3;
  };

  const auto left = minimise(first_numbers(20), fails);

  EXPECT_EQ(left.size(), 3u);
  EXPECT_TRUE(fails(left));
}

TEST(Minimise, AsksInTheOrderOfTheSquareOfTheItemsAtMost) {
  std::size_t asked = 0;
  const auto all = first_numbers(32);

  // All are needed: the worst case, n^2 + 3 n of the paper.
  const auto left = minimise(all, [&](const Items& items) {
    ++asked;
    return items.size() == all.size();
  });

  EXPECT_EQ(left, all);
  EXPECT_LE(asked, 32u * 32u + 3u * 32u);
}

}  // namespace
}  // namespace clew::hunt

// SPDX-License-Identifier: Apache-2.0
#include "classify/class_sequence.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace clew::classify {
namespace {

void add_all(ClassSequence& sequence, const std::vector<int>& classes) {
  for (const int spatial_class : classes) sequence.add(static_cast<std::uint8_t>(spatial_class));
}

TEST(ClassSequence, MakesALandmarkOfThreeRuns) {
  ClassSequence sequence(true);

  add_all(sequence, {3, 3, 3, 3, 1, 1, 0});

  // Figure 1: a corridor with a dead end.
  ASSERT_TRUE(sequence.complete());
  EXPECT_EQ(sequence.classes(), (Triple{3, 1, 0}));
  EXPECT_EQ(sequence.lengths(), (RunLengths{4, 2, 1}));
}

TEST(ClassSequence, IsNotCompleteBeforeTheThirdRunBegins) {
  ClassSequence sequence(true);

  add_all(sequence, {3, 3, 3, 1, 1});

  EXPECT_FALSE(sequence.complete());
}

TEST(ClassSequence, TellsWhenARunBegins) {
  ClassSequence sequence(true);

  EXPECT_TRUE(sequence.add(3));
  EXPECT_FALSE(sequence.add(3));
  EXPECT_TRUE(sequence.add(1));
  EXPECT_EQ(sequence.current().length, 1u);
}

TEST(ClassSequence, CountsTheRunThatLasts) {
  ClassSequence sequence(true);

  add_all(sequence, {7, 1, 0, 0, 0});

  EXPECT_EQ(sequence.lengths(), (RunLengths{1, 1, 3}));
}

TEST(ClassSequence, SlidesByOneRun) {
  ClassSequence sequence(true);

  add_all(sequence, {7, 1, 0, 0, 5});

  EXPECT_EQ(sequence.classes(), (Triple{1, 0, 5}));
  EXPECT_EQ(sequence.lengths(), (RunLengths{1, 2, 1}));
}

TEST(ClassSequence, BeginsAfreshAfterThreeRunsWhenItDoesNotSlide) {
  ClassSequence sequence(false);

  add_all(sequence, {7, 1, 0, 5, 8});
  EXPECT_FALSE(sequence.complete());
  add_all(sequence, {2});

  EXPECT_EQ(sequence.classes(), (Triple{5, 8, 2}));
}

TEST(LowerBounds, AreReachedByRunsThatAreAsLong) {
  EXPECT_TRUE(reaches({4, 2, 1}, {4, 2, 1}));
  EXPECT_FALSE(reaches({3, 2, 1}, {4, 2, 1}));
  EXPECT_FALSE(reaches({9, 1, 9}, {4, 2, 1}));
}

}  // namespace
}  // namespace clew::classify

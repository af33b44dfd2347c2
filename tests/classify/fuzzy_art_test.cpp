// SPDX-License-Identifier: Apache-2.0
/// Fuzzy ART against computations by hand: appendix B of Krishna & Kalra 2000, with classes / 8.
#include "classify/fuzzy_art.hpp"

#include <gtest/gtest.h>

namespace clew::classify {
namespace {

constexpr double kTolerance = 1e-12;

TEST(FuzzyArt, CommitsANewCategoryAtOnce) {
  FuzzyArt art({});

  const FuzzyArt::Answer answer = art.present({8, 4, 0}, 5);

  // y = (1, 0.5, 0); Y = (1, 0.5, 0, 0, 0.5, 1).
  EXPECT_TRUE(answer.created);
  EXPECT_EQ(answer.category, 0u);
  EXPECT_EQ(art.state().categories[0].weights, (std::array<double, 6>{1, 0.5, 0, 0, 0.5, 1}));
  EXPECT_EQ(art.prototype(0), (std::array<double, 3>{8, 4, 0}));
}

TEST(FuzzyArt, TakesTheSameVectorForTheSameCategory) {
  FuzzyArt art({});
  art.present({8, 4, 0}, 5);

  const FuzzyArt::Answer answer = art.present({8, 4, 0}, 6);

  EXPECT_FALSE(answer.created);
  EXPECT_EQ(answer.category, 0u);
  EXPECT_EQ(art.state().categories[0].weights, (std::array<double, 6>{1, 0.5, 0, 0, 0.5, 1}));
}

TEST(FuzzyArt, LearnsBySharesOfTheForgettingFactor) {
  FuzzyArt art({});
  art.present({8, 4, 0}, 5);

  const FuzzyArt::Answer answer = art.present({8, 6, 0}, 6);

  // Y = (1, 0.75, 0, 0, 0.25, 1), Y ^ Z = (1, 0.5, 0, 0, 0.25, 1): 2.75 / 3 = 0.917 passes 0.9.
  // Z = 0.85 (Y ^ Z) + 0.15 Z: only the fifth component changes, to 0.85 x 0.25 + 0.15 x 0.5.
  EXPECT_FALSE(answer.created);
  const auto& weights = art.state().categories[0].weights;
  EXPECT_NEAR(weights[1], 0.5, kTolerance);
  EXPECT_NEAR(weights[4], 0.2875, kTolerance);
  // The middle of [0.5, 1 - 0.2875], in classes: 4 x (0.5 + 0.7125).
  EXPECT_NEAR(art.prototype(0)[1], 4.85, kTolerance);
}

TEST(FuzzyArt, TakesVectorsTogetherThatDifferByTwoClassesButNotByThree) {
  FuzzyArt art({});
  art.present({7, 1, 5}, 1);

  // |Y ^ Z| = 3 - d / 8 against 0.9 x 3 = 2.7: d = 2 gives 2.75, d = 3 gives 2.625.
  EXPECT_FALSE(art.present({7, 1, 7}, 2).created);
  EXPECT_TRUE(FuzzyArt(art).present({7, 4, 5}, 3).created);
}

TEST(FuzzyArt, ChoosesTheCategoryOfHighestChoiceAmongThoseThatResonate) {
  FuzzyArt art({});
  art.present({4, 4, 4}, 1);
  art.present({4, 4, 8}, 2);  // differs by 4: a category of its own

  // [4 4 6] differs by 2 from both: |Y ^ Z| = 2.75 and |Z| = 3 for both, so the first wins; [4 4 7]
  // resonates with the second alone.
  EXPECT_EQ(FuzzyArt(art).present({4, 4, 6}, 3).category, 0u);
  EXPECT_EQ(FuzzyArt(art).present({4, 4, 7}, 3).category, 1u);
}

TEST(FuzzyArt, PassesOverAWinnerThatFailsTheVigilanceTest) {
  FuzzyArt art({});
  art.present({4, 4, 4}, 1);
  art.present({4, 4, 6}, 2);  // widens category 0 to [4, 4, 4..5.7]
  art.present({1, 4, 4}, 3);  // differs by 3 and more: category 1, a point

  // [3 4 4]: |Y ^ Z0| = |Z0| - 1/8 is a share of (|Z0| - 0.125) / (delta + |Z0|) with |Z0| =
  // 3 - 0.2125; |Y ^ Z1| = 2.75 of 3.
  // choice 0 = 2.6625 / 2.7885 = 0.9548 (but its match 2.6625 / 3 = 0.8875 fails the vigilance);
  // choice 1 = 2.75 / 3.001 = 0.9164, match 0.917 passes.
  EXPECT_EQ(art.present({3, 4, 4}, 4).category, 1u);
}

TEST(FuzzyArt, ForgetsACategoryThatHasNotWonForLong) {
  FuzzyArtParameters parameters;
  parameters.forget_ticks = 100;
  FuzzyArt art(parameters);
  art.present({8, 4, 0}, 5);

  EXPECT_FALSE(FuzzyArt(art).present({8, 4, 0}, 105).created);
  EXPECT_TRUE(FuzzyArt(art).present({8, 4, 0}, 106).created);
}

TEST(FuzzyArt, NeverForgetsOnRequest) {
  FuzzyArtParameters parameters;
  parameters.forget_ticks = 0;
  FuzzyArt art(parameters);
  art.present({8, 4, 0}, 5);

  EXPECT_FALSE(art.present({8, 4, 0}, 1000000).created);
}

TEST(FuzzyArt, GivesUpTheCategoryThatWonLeastRecentlyWhenAllAreTaken) {
  FuzzyArtParameters parameters;
  parameters.capacity = 2;
  FuzzyArt art(parameters);
  art.present({0, 0, 0}, 1);
  art.present({8, 8, 8}, 2);
  art.present({0, 0, 0}, 3);

  const FuzzyArt::Answer answer = art.present({0, 8, 0}, 4);

  EXPECT_TRUE(answer.created);
  EXPECT_EQ(answer.category, 1u);
  EXPECT_FALSE(art.present({0, 0, 0}, 5).created);
}

}  // namespace
}  // namespace clew::classify

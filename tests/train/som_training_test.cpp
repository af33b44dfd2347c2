// SPDX-License-Identifier: Apache-2.0
#include "train/som_training.hpp"

#include <gtest/gtest.h>

#include "classify/spatial_classes.hpp"
#include "tests/source_files.hpp"

namespace clew::train {
namespace {

using classify::Som;
using tests::file_of;
using tests::with;

core::Resource shipped_recipe() { return file_of("configs/training/krishna_kalra_som.yaml"); }

std::string refusal_of(const std::string& from, const std::string& to) {
  const auto recipe = SomRecipe::parse({"recipe.yaml", with(shipped_recipe().text, from, to)});
  return recipe.ok() ? "accepted" : recipe.error().message;
}

SomRecipe small_recipe() {
  SomRecipe recipe = SomRecipe::parse(shipped_recipe()).value();
  recipe.scales = {1.0, 0.5};
  recipe.worlds = {"corridor"};
  return recipe;
}

/// The classes of a run with these lengths of 3, 1, 0, and a short run of 8 before.
LandmarkRun corridor(double scale, int three, int one, int zero) {
  LandmarkRun run{"corridor", scale, {8}};
  run.classes.insert(run.classes.end(), static_cast<std::size_t>(three), 3);
  run.classes.insert(run.classes.end(), static_cast<std::size_t>(one), 1);
  run.classes.insert(run.classes.end(), static_cast<std::size_t>(zero), 0);
  return run;
}

Som map_of(const std::string& text) {
  auto map = Som::parse({"trained.yaml", text});
  EXPECT_TRUE(map.ok()) << map.error().text();
  return std::move(map).value();
}

TEST(MirroredClass, SwapsLeftAndRightInTableOne) {
  const std::uint8_t expected[classify::kSpatialClasses] = {0, 1, 5, 3, 7, 2, 6, 4, 8};

  for (std::uint8_t i = 0; i < classify::kSpatialClasses; ++i) EXPECT_EQ(mirrored(i), expected[i]);
}

TEST(SomTraining, LearnsALandmarkAndTheBoundsOfItsSmallestCopy) {
  const auto text =
      train_som(small_recipe(), {corridor(1.0, 20, 5, 4), corridor(0.5, 9, 3, 6)}, "train");
  ASSERT_TRUE(text.ok()) << text.error().text();

  const Som map = map_of(*text);
  const Som::Recall recall = map.recall({3, 1, 0});

  // The third run counts only until the vector is complete, after one tick.
  EXPECT_LT(recall.distance, 0.5);
  EXPECT_EQ(map.neuron(recall.neuron).lower_bounds, (RunLengths{9, 3, 1}));
}

TEST(SomTraining, GivesBoundsOnlyToNeuronsThatStandForALandmark) {
  const auto text =
      train_som(small_recipe(), {corridor(1.0, 20, 5, 4), corridor(0.5, 9, 3, 6)}, "train");
  ASSERT_TRUE(text.ok()) << text.error().text();

  const Som map = map_of(*text);
  int with_bounds = 0;
  for (std::uint32_t i = 0; i < Som::kNeurons; ++i) {
    if (map.neuron(i).lower_bounds) ++with_bounds;
  }

  // One landmark, its own mirror image.
  EXPECT_EQ(with_bounds, 1);
}

TEST(SomTraining, GivesTheSameBytesForTheSameRuns) {
  const std::vector<LandmarkRun> runs = {corridor(1.0, 20, 5, 4), corridor(0.5, 9, 3, 6)};

  EXPECT_EQ(*train_som(small_recipe(), runs, "train"), *train_som(small_recipe(), runs, "train"));
}

TEST(SomTraining, DependsOnTheSeed) {
  const std::vector<LandmarkRun> runs = {corridor(1.0, 20, 5, 4)};
  SomRecipe other = small_recipe();
  other.seed = 2;

  EXPECT_NE(*train_som(small_recipe(), runs, "train"), *train_som(other, runs, "train"));
}

TEST(SomTraining, RecordsWhereTheMapComesFrom) {
  const auto text = train_som(small_recipe(), {corridor(1.0, 20, 5, 4)}, "clew train som");
  ASSERT_TRUE(text.ok()) << text.error().text();

  EXPECT_NE(text->find("command: \"clew train som\""), std::string::npos);
  EXPECT_NE(text->find("seed: 1\n"), std::string::npos);
  EXPECT_NE(text->find("- corridor\n"), std::string::npos);
}

TEST(SomTraining, LearnsNothingFromFreeSpace) {
  const LandmarkRun run{"corridor", 1.0, {8, 8, 8, 7, 7, 8, 8, 8, 8, 4, 4, 8}};

  const auto text = train_som(small_recipe(), {run}, "train");

  // [8 7 8], [7 8 4] and [8 4 8] begin with, hold, or come back to class 8.
  ASSERT_FALSE(text.ok());
  EXPECT_EQ(text.error().message, "the runs show no landmark");
}

TEST(SomRecipe, ShipsWithAtLeastAHundredIterationsANeuron) {
  const auto recipe = SomRecipe::parse(shipped_recipe());

  ASSERT_TRUE(recipe.ok()) << recipe.error().text();
  EXPECT_GE(recipe->iterations, 100 * Som::kNeurons);
  EXPECT_EQ(recipe->scales.front(), 1.0);
  EXPECT_EQ(recipe->least_runs, (RunLengths{3, 2, 1}));
}

TEST(SomRecipe, RefusesWhatIsNoRecipe) {
  EXPECT_EQ(refusal_of("iterations: 9800", "iterations: 100"),
            "found '100', expected a whole number from 4900 to 1000000000");
  EXPECT_EQ(refusal_of("[1, 0.9, 0.8, 0.7, 0.6]", "[0.9, 0.8]"),
            "scales fall from 1 and stay above 0");
  EXPECT_EQ(refusal_of("learning_rate: [0.5, 0.02]", "learning_rate: [0.5, 0]"),
            "expected [first, last] with 0 < last <= first <= 1");
  EXPECT_EQ(refusal_of("least_runs_ticks: [3, 2, 1]", "least_runs_ticks: [3, 2]"),
            "found a list of 2, expected three counts");
}

}  // namespace
}  // namespace clew::train

// SPDX-License-Identifier: Apache-2.0
#include "train/som_training.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

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
  recipe.scale_step = 0.25;
  recipe.worlds = {"corridor"};
  return recipe;
}

/// The classes of a run with these lengths of 3, 1, 0, and a short run of 8 before.
ClassesSeen corridor(int three, int one, int zero) {
  ClassesSeen classes = {8};
  classes.insert(classes.end(), static_cast<std::size_t>(three), 3);
  classes.insert(classes.end(), static_cast<std::size_t>(one), 1);
  classes.insert(classes.end(), static_cast<std::size_t>(zero), 0);
  return classes;
}

/// Runs past a world at full size and past its copies; below the last one there is no room.
RunPast past(std::vector<ClassesSeen> copies, double scale_step = 0.25) {
  return [copies = std::move(copies), scale_step](const std::string&, double scale) {
    const auto copy = static_cast<std::size_t>(std::lround((1.0 - scale) / scale_step));
    return core::Result<ClassesSeen>(copy < copies.size() ? copies[copy] : ClassesSeen());
  };
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

RunLengths bounds_of_corridor(const RunPast& run_past) {
  const auto text = train_som(small_recipe(), run_past, "train");
  EXPECT_TRUE(text.ok());
  const Som map = map_of(*text);
  const Som::Recall recall = map.recall({3, 1, 0});
  EXPECT_LT(recall.distance, 0.5);
  return map.neuron(recall.neuron).lower_bounds.value_or(RunLengths{});
}

TEST(SomTraining, LearnsALandmarkAndTheBoundsOfItsSmallestCopy) {
  // The third run counts only until the vector is complete, after one tick.
  EXPECT_EQ(bounds_of_corridor(past({corridor(20, 5, 4), corridor(9, 3, 6)})),
            (RunLengths{9, 3, 1}));
}

TEST(SomTraining, TakesTheShortestOfEachRunFromAnyCopy) {
  EXPECT_EQ(bounds_of_corridor(past({corridor(20, 3, 4), corridor(9, 7, 6), corridor(12, 5, 5)})),
            (RunLengths{9, 3, 1}));
}

TEST(SomTraining, GoesOnToSmallerCopiesWhenOneShowsNothing) {
  EXPECT_EQ(bounds_of_corridor(past({corridor(20, 5, 4), {8, 8, 8}, corridor(4, 2, 1)})),
            (RunLengths{4, 2, 1}));
}

TEST(SomTraining, TakesNoBoundsBelowTheFloor) {
  EXPECT_EQ(bounds_of_corridor(past({corridor(20, 5, 4), corridor(2, 2, 1)})),
            (RunLengths{20, 5, 1}));
}

TEST(SomTraining, GivesBoundsOnlyToNeuronsThatStandForALandmark) {
  const auto text = train_som(small_recipe(), past({corridor(20, 5, 4)}), "train");
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
  const RunPast run_past = past({corridor(20, 5, 4), corridor(9, 3, 6)});

  EXPECT_EQ(*train_som(small_recipe(), run_past, "train"),
            *train_som(small_recipe(), run_past, "train"));
}

TEST(SomTraining, DependsOnTheSeed) {
  const RunPast run_past = past({corridor(20, 5, 4)});
  SomRecipe other = small_recipe();
  other.seed = 2;

  EXPECT_NE(*train_som(small_recipe(), run_past, "train"), *train_som(other, run_past, "train"));
}

TEST(SomTraining, TellsWhyAWorldCannotBeRun) {
  const RunPast none = [](const std::string& world, double) {
    return core::Result<ClassesSeen>(core::Error{"no world " + world});
  };

  const auto text = train_som(small_recipe(), none, "train");

  ASSERT_FALSE(text.ok());
  EXPECT_EQ(text.error().message, "no world corridor");
}

TEST(SomTraining, RecordsWhereTheMapComesFrom) {
  const auto text = train_som(small_recipe(), past({corridor(20, 5, 4)}), "clew train som");
  ASSERT_TRUE(text.ok()) << text.error().text();

  EXPECT_NE(text->find("command: \"clew train som\""), std::string::npos);
  EXPECT_NE(text->find("seed: 1\n"), std::string::npos);
  EXPECT_NE(text->find("- corridor\n"), std::string::npos);
}

TEST(SomTraining, LearnsNothingFromFreeSpace) {
  const auto text =
      train_som(small_recipe(), past({{8, 8, 8, 7, 7, 8, 8, 8, 8, 4, 4, 8}}), "train");

  // [8 7 8], [7 8 4] and [8 4 8] begin with, hold, or come back to class 8.
  ASSERT_FALSE(text.ok());
  EXPECT_EQ(text.error().message, "the runs show no landmark");
}

TEST(SomRecipe, ShipsWithAtLeastAHundredIterationsANeuron) {
  const auto recipe = SomRecipe::parse(shipped_recipe());

  ASSERT_TRUE(recipe.ok()) << recipe.error().text();
  EXPECT_GE(recipe->iterations, 100 * Som::kNeurons);
  EXPECT_EQ(recipe->least_runs, (RunLengths{3, 2, 1}));
}

TEST(SomRecipe, RefusesWhatIsNoRecipe) {
  EXPECT_EQ(refusal_of("iterations: 9800", "iterations: 100"),
            "found '100', expected a whole number from 4900 to 1000000000");
  EXPECT_EQ(refusal_of("scale_step: 0.05", "scale_step: 0"),
            "found 0, expected a number from 0.01 to 0.5");
  EXPECT_EQ(refusal_of("learning_rate: [0.5, 0.02]", "learning_rate: [0.5, 0]"),
            "expected [first, last] with 0 < last <= first <= 1");
  EXPECT_EQ(refusal_of("least_runs_ticks: [3, 2, 1]", "least_runs_ticks: [3, 2]"),
            "found a list of 2, expected three counts");
}

}  // namespace
}  // namespace clew::train

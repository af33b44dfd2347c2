// SPDX-License-Identifier: Apache-2.0
#include "train/neuro_fuzzy_training.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "control/infrared/infrared_expert.hpp"
#include "core/random.hpp"
#include "tests/source_files.hpp"
#include "train/larger_table.hpp"
#include "train/neuro_fuzzy_start.hpp"

namespace clew::train {
namespace {

using tests::file_of;

constexpr char kRecipe[] = "configs/training/wang_yang_meng.yaml";

NeuroFuzzyRecipe recipe() { return NeuroFuzzyRecipe::parse(file_of(kRecipe)).value(); }

NeuroFuzzyNets rules() {
  return NeuroFuzzyNets::parse(file_of("configs/rulebases/wang_yang_meng.yaml")).value();
}

std::string refusal_of(const std::string& from, const std::string& to) {
  std::string text = file_of(kRecipe).text;
  text.replace(text.find(from), from.size(), to);
  const auto parsed = NeuroFuzzyRecipe::parse({"recipe.yaml", text});
  return parsed.ok() ? "accepted" : parsed.error().message;
}

/// The expert's opinion of distances at random within the sensors' range.
std::vector<TrainingGroup> shown_groups(std::size_t count) {
  const domain::InfraredCurve curve;
  const core::Random random({3, 0, 0, 0});
  std::vector<TrainingGroup> groups;
  for (std::uint32_t n = 0; n < count; ++n) {
    control::InfraredDistances distances_m{};
    TrainingGroup group;
    for (std::uint32_t side = 0; side < distances_m.size(); ++side) {
      distances_m[side] = 0.1 + 0.7 * random.uniform(4 * n + side);
      group.readings[side] = curve.reading(distances_m[side]);
    }
    group.wanted = control::expert_opinion({}, distances_m);
    control::InfraredDistances beside_free = distances_m;
    beside_free[control::kLeft] = beside_free[control::kRight] = 9.0;
    const control::WheelSpeeds ahead = control::expert_opinion({}, beside_free);
    group.parts_mps = {ahead.left_mps, ahead.right_mps, group.wanted.left_mps - ahead.left_mps,
                       group.wanted.right_mps - ahead.right_mps};
    groups.push_back(group);
  }
  return groups;
}

TrainingGroups drawn() { return draw_groups(recipe(), shown_groups(400)).value(); }

TEST(DrawGroups, GivesAsManyAsTheRecipeAsksForWithoutAnOverlap) {
  const TrainingGroups groups = drawn();

  EXPECT_EQ(groups.train.size(), 100u);
  EXPECT_EQ(groups.test.size(), 56u);
  for (const TrainingGroup& test : groups.test) {
    for (const TrainingGroup& train : groups.train) EXPECT_NE(test.readings, train.readings);
  }
}

TEST(DrawGroups, AveragesWhatIsWantedForEqualReadings) {
  NeuroFuzzyRecipe two = recipe();
  two.train_groups = 1;
  two.test_groups = 1;
  const InfraredReadings same = {50, 60, 70, 80};

  const auto groups =
      draw_groups(two, {{same, {0.1, 0.4}}, {{1, 2, 3, 4}, {0.9, 0.9}}, {same, {0.3, 0.2}}});

  ASSERT_TRUE(groups.ok()) << groups.error().text();
  const TrainingGroup& merged =
      groups->train[0].readings == same ? groups->train[0] : groups->test[0];
  EXPECT_EQ(merged.readings, same);
  EXPECT_NEAR(merged.wanted.left_mps, 0.2, 1e-15);
  EXPECT_NEAR(merged.wanted.right_mps, 0.3, 1e-15);
}

TEST(DrawGroups, RefusesTooFew) {
  const auto groups = draw_groups(recipe(), shown_groups(20));

  ASSERT_FALSE(groups.ok());
  EXPECT_EQ(groups.error().message,
            "the runs show 20 different combinations of readings; the recipe needs 100 groups to "
            "train and 56 to test");
}

TEST(NeuroFuzzyTraining, LearnsTheExpertBetterThanTablesOfFourTimesTheSize) {
  const TrainingGroups groups = drawn();

  const NeuroFuzzyTraining training = train_neuro_fuzzy(recipe(), rules(), groups);
  const TestErrors errors = compare(training, rules(), groups);

  // 0.017 m/s against 0.039 of the table filled from the same groups, and 0.107 of the rules.
  EXPECT_LT(errors.trained_mps, 0.02);
  EXPECT_LT(2.0 * errors.trained_mps, errors.filled_mps);
  EXPECT_LT(5.0 * errors.trained_mps, errors.interpolated_mps);
  EXPECT_LT(5.0 * errors.trained_mps, errors.rules_mps);
}

TEST(NeuroFuzzyTraining, TellsItsErrorsFromTheFirstIterationToTheLast) {
  const TrainingGroups groups = drawn();

  const NeuroFuzzyTraining training = train_neuro_fuzzy(recipe(), rules(), groups);

  ASSERT_EQ(training.curve.size(), 151u);
  EXPECT_EQ(training.curve.front().iteration, 0u);
  EXPECT_NEAR(training.curve.front().test_mps, error_mps(rules(), groups.test), 1e-15);
  EXPECT_EQ(training.curve.back().iteration, 30000u);
  EXPECT_EQ(training.curve.back().train_mps, error_mps(training.nets, groups.train));
}

TEST(NeuroFuzzyTraining, StopsWhereTheErrorIsBelowTheTolerance) {
  NeuroFuzzyRecipe easy = recipe();
  easy.tolerance_mps = 0.03;

  const NeuroFuzzyTraining training = train_neuro_fuzzy(easy, rules(), drawn());

  EXPECT_LT(training.curve.back().train_mps, 0.03);
  EXPECT_LT(training.curve.back().iteration, 30000u);
  EXPECT_GE(training.curve[training.curve.size() - 2].train_mps, 0.03);
}

TEST(NeuroFuzzyTraining, KeepsTableOneFromLookingBack) {
  const NeuroFuzzyTraining training = train_neuro_fuzzy(recipe(), rules(), drawn());

  const auto& nets = training.nets.nets;
  EXPECT_TRUE(nets[NeuroFuzzyNets::kLeft1].ignores_second());
  EXPECT_TRUE(nets[NeuroFuzzyNets::kRight1].ignores_second());
  EXPECT_FALSE(nets[NeuroFuzzyNets::kLeft2].ignores_second());
}

TEST(NeuroFuzzyTraining, GivesTheSameFileForTheSameGroupsAndSeedAlone) {
  const TrainingGroups groups = drawn();
  const auto file_with = [&](std::uint64_t seed) {
    NeuroFuzzyRecipe seeded = recipe();
    seeded.seed = seed;
    return trained_file(seeded, train_neuro_fuzzy(seeded, rules(), groups), {}, "train", "");
  };

  EXPECT_EQ(file_with(1), file_with(1));
  EXPECT_NE(file_with(1).substr(file_with(1).find("nets:")),
            file_with(2).substr(file_with(2).find("nets:")));
}

TEST(StartNetworks, AreTheRulesUnlessTheRecipeSaysOtherwise) {
  const auto begun = start_networks(recipe(), rules(), drawn());

  ASSERT_TRUE(begun.ok()) << begun.error().text();
  EXPECT_EQ(begun->to_yaml(), rules().to_yaml());
}

TEST(StartNetworks, LaySetsEvenlyOverTheReadings) {
  NeuroFuzzyRecipe over = recipe();
  over.sets = StartSets::kReadings;
  TrainingGroups groups;
  groups.train = {{{200, 180, 160, 190}, {}, {}}, {{180, 220, 200, 190}, {}, {}}};

  const auto begun = start_networks(over, rules(), groups);

  ASSERT_TRUE(begun.ok()) << begun.error().text();
  const auto& net = begun->nets[NeuroFuzzyNets::kRight1];
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(net.centres[0][i], 160.0 + 20.0 * static_cast<double>(i), 1e-9);
    EXPECT_NEAR(net.centres[1][i], 160.0 + 20.0 * static_cast<double>(i), 1e-9);
    // Half way between two centres both hold to a half.
    EXPECT_NEAR(std::exp(-0.5 * 100.0 / (net.widths[0][i] * net.widths[0][i])), 0.5, 1e-4);
  }
}

TEST(StartNetworks, RefuseSetsThatHoldFewReadings) {
  TrainingGroups groups;
  groups.train = {{{230, 100, 100, 100}, {}, {}}, {{240, 100, 100, 100}, {}, {}}};

  const auto begun = start_networks(recipe(), rules(), groups);

  ASSERT_FALSE(begun.ok());
  EXPECT_EQ(
      begun.error().message,
      "0 % of what sensor I_1 read lies in the sets of the rules that training begins with: "
      "readings from 230 to 240, centres from 45 to 180; the recipe key 'sets: readings' lays "
      "them over the readings, as in the recipe wang_yang_meng_readings");
}

TEST(StartNetworks, DrawOutputsFromNothingToOneAndTableOneStillLooksAhead) {
  NeuroFuzzyRecipe from_nothing = recipe();
  from_nothing.outputs = StartOutputs::kRandom;

  const auto begun = start_networks(from_nothing, rules(), drawn());

  ASSERT_TRUE(begun.ok()) << begun.error().text();
  EXPECT_TRUE(begun->nets[NeuroFuzzyNets::kLeft1].ignores_second());
  EXPECT_FALSE(begun->nets[NeuroFuzzyNets::kLeft2].ignores_second());
  EXPECT_NE(begun->nets[NeuroFuzzyNets::kLeft1].outputs,
            begun->nets[NeuroFuzzyNets::kRight1].outputs);
  for (const auto& net : begun->nets) {
    for (const auto& row : net.outputs) {
      for (const double output : row) {
        EXPECT_GE(output, 0.0);
        EXPECT_LT(output, 1.0);
      }
    }
  }
}

TEST(NeuroFuzzyTraining, LearnsFromRandomOutputsAsWell) {
  NeuroFuzzyRecipe from_nothing = recipe();
  from_nothing.outputs = StartOutputs::kRandom;
  from_nothing.sets = StartSets::kReadings;
  const TrainingGroups groups = drawn();
  const NeuroFuzzyNets begun = start_networks(from_nothing, rules(), groups).value();

  const NeuroFuzzyTraining training = train_neuro_fuzzy(from_nothing, begun, groups);

  EXPECT_GT(error_mps(begun, groups.test), 0.2);
  EXPECT_LT(error_mps(training.nets, groups.test), 0.04);
}

TEST(NeuroFuzzyTraining, EachNetworkLearnsFromGroupsOfItsOwn) {
  NeuroFuzzyRecipe each = recipe();
  each.each_network = true;
  const auto groups = draw_groups(each, shown_groups(800));
  ASSERT_TRUE(groups.ok()) << groups.error().text();
  for (const auto& own : groups->of_network) {
    EXPECT_EQ(own.size(), 100u);
    for (const TrainingGroup& test : groups->test) EXPECT_NE(own.front().readings, test.readings);
  }

  const NeuroFuzzyTraining training = train_neuro_fuzzy(each, rules(), *groups);

  EXPECT_LT(error_mps(training.nets, groups->test), 0.03);
  EXPECT_FALSE(draw_groups(each, shown_groups(400)).ok());
}

TEST(NeuroFuzzyRecipe, RefusesWordsThatItDoesNotKnow) {
  EXPECT_EQ(refusal_of("iterations: 30000", "sets: mine\niterations: 30000"),
            "found 'mine'; allowed: rules, readings");
  EXPECT_EQ(refusal_of("iterations: 30000", "learn: all\niterations: 30000"),
            "found 'all'; allowed: wheels, networks");
}

TEST(LargerTable, HasTheOpinionOfItsRules) {
  const NeuroFuzzyNets few = rules();

  const LargerTable many = LargerTable::interpolated(few);

  // At the corners of the grid, where rules of both sizes are the same, but for what neighbours
  // add: 0.062 of one word with four sets, and of a third of one with eight.
  for (const double ahead : {45.0, 180.0}) {
    for (const double left : {45.0, 180.0}) {
      const InfraredReadings readings = {ahead, 180.0, left, 180.0};
      EXPECT_NEAR(many.speeds(readings).left_mps, few.speeds(readings).left_mps, 0.02);
      EXPECT_NEAR(many.speeds(readings).right_mps, few.speeds(readings).right_mps, 0.02);
    }
  }
}

TEST(NeuroFuzzyRecipe, ShipsWithThePapersSizesAndLarger) {
  const auto large = NeuroFuzzyRecipe::parse(file_of("configs/training/wang_yang_meng_large.yaml"));

  EXPECT_EQ(recipe().train_groups, 100u);
  EXPECT_EQ(recipe().test_groups, 56u);
  EXPECT_EQ(recipe().iterations, 30000u);
  ASSERT_TRUE(large.ok()) << large.error().text();
  EXPECT_EQ(large->train_groups, 1000u);
}

TEST(NeuroFuzzyRecipe, RefusesWhatIsNone) {
  EXPECT_EQ(refusal_of("train: 100", "train: 0"),
            "found '0', expected a whole number from 1 to 10000000");
  EXPECT_EQ(refusal_of("outputs: 0.1", "outputs: 2"), "found 2, expected a number from 0 to 1");
  EXPECT_EQ(refusal_of("places: 1000\nworlds:", "places: 1000\nworlds: []\nworld:"),
            "unknown key 'world' (did you mean 'worlds'?); allowed: format, seed, start, sets, "
            "outputs, learn, groups, iterations, tolerance_mps, learning_rates, wheel_base_m, "
            "places, worlds");
}

}  // namespace
}  // namespace clew::train

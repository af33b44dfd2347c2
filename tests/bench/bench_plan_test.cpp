// SPDX-License-Identifier: Apache-2.0
#include "bench/bench_plan.hpp"

#include <gtest/gtest.h>

#include "stages/all.hpp"
#include "tests/source_path.hpp"

namespace clew::bench {
namespace {

runtime::ConfigPath configs() { return runtime::ConfigPath({tests::source_path("configs")}); }

Suite small_suite() {
  Suite suite;
  suite.name = "small";
  suite.graphs = {"krishna_kalra", "reactive"};
  suite.worlds = {{"traps", {"u-trap"}}};
  return suite;
}

Variation varied(const std::string& path, const std::vector<std::vector<std::string>>& values) {
  Variation variation{path, {}};
  for (const auto& words : values) variation.values.push_back({words});
  return variation;
}

core::Result<BenchPlan> plan(const Suite& suite, const BenchChanges& changes = {}) {
  return plan_bench(suite, changes, configs(), stages::all());
}

TEST(BenchPlan, EverySuiteThatShipsHasAPlan) {
  const auto names = configs().names("suites");

  EXPECT_GE(names.size(), 3u);
  for (const std::string& name : names) {
    const auto suite = read_suite(*configs().find("suites", name), name);
    ASSERT_TRUE(suite.ok()) << suite.error().text();
    const auto planned = plan(*suite);
    if (suite->needs_barn) {  // whose worlds a user has
      EXPECT_FALSE(planned.ok());
      continue;
    }
    ASSERT_TRUE(planned.ok()) << name << ": " << planned.error().text();
    EXPECT_GT(planned->runs(), 0u) << name;
  }
}

TEST(BenchPlan, VariationsMakeEveryCombination) {
  Suite suite = small_suite();
  suite.graphs = {"krishna_kalra"};
  BenchChanges changes;
  changes.variations = {
      varied("recover.detector", {{"landmark_revisit"}, {"none"}}),
      varied("recover.escape", {{"obstacle_following"}, {"none", "obstacle_following"}})};

  const auto planned = plan(suite, changes);

  ASSERT_TRUE(planned.ok()) << planned.error().text();
  std::vector<std::string> labels;
  for (const Variant& variant : planned->variants) labels.push_back(variant.label());
  EXPECT_EQ(
      labels,
      (std::vector<std::string>{
          "krishna_kalra [recover.detector=landmark_revisit recover.escape=obstacle_following]",
          "krishna_kalra [recover.detector=landmark_revisit "
          "recover.escape=none+obstacle_following]",
          "krishna_kalra [recover.detector=none recover.escape=obstacle_following]",
          "krishna_kalra [recover.detector=none recover.escape=none+obstacle_following]"}));
  EXPECT_EQ(planned->variants[1].overrides.with.back(), "recover.escape=none,obstacle_following");
}

TEST(BenchPlan, ParametersAreVariedAsWell) {
  Suite suite = small_suite();
  BenchChanges changes;
  changes.variations = {varied("sense.range_m", {{"1.2"}, {"1.8"}})};

  const auto planned = plan(suite, changes);

  ASSERT_TRUE(planned.ok()) << planned.error().text();
  EXPECT_EQ(planned->variants.size(), 4u);
  EXPECT_EQ(planned->variants[3].label(), "reactive [sense.range_m=1.8]");
  EXPECT_EQ(planned->variants[3].overrides.set.back(), "sense.range_m=1.8");
}

TEST(BenchPlan, ParametersAreSetAlongWithABehaviour) {
  Suite suite = small_suite();
  suite.graphs = {"any_sensor"};
  suite.variations = {varied("sense", {{"cones"}, {"laser"}, {"laser"}}),
                      varied("recover.escape", {{"remembered_map"}})};
  suite.variations[0].values[1].settings = {{"range_m", "4"}};
  suite.variations[0].values[2].settings = {{"range_m", "2"}};
  suite.variations[1].values[0].settings = {{"close_m", "0.5"}};

  const auto planned = plan(suite);

  ASSERT_TRUE(planned.ok()) << planned.error().text();
  ASSERT_EQ(planned->variants.size(), 3u);
  EXPECT_EQ(planned->variants[1].label(), "any_sensor [sense=laser(range_m=4)]");
  EXPECT_EQ(planned->variants[2].label(), "any_sensor [sense=laser(range_m=2)]");
  EXPECT_EQ(planned->variants[0].overrides.set,
            (std::vector<std::string>{"recover.escape.remembered_map.close_m=0.5"}));
  EXPECT_EQ(
      planned->variants[1].overrides.set,
      (std::vector<std::string>{"sense.range_m=4", "recover.escape.remembered_map.close_m=0.5"}));
}

TEST(BenchPlan, ChangesReplaceGraphsAndVariationsOfTheSuite) {
  Suite suite = small_suite();
  suite.variations = {varied("sense.range_m", {{"1.2"}, {"1.5"}, {"1.8"}})};
  BenchChanges changes;
  changes.graphs = {"reactive"};
  changes.variations = {varied("sense.range_m", {{"2"}})};

  const auto planned = plan(suite, changes);

  ASSERT_TRUE(planned.ok()) << planned.error().text();
  ASSERT_EQ(planned->variants.size(), 1u);
  // A single value tells no two variants apart.
  EXPECT_EQ(planned->variants[0].label(), "reactive");
  EXPECT_EQ(planned->variants[0].overrides.set.back(), "sense.range_m=2");
}

TEST(BenchPlan, TheCommandLineOutranksWhatASuiteSets) {
  Suite suite = small_suite();
  suite.variations = {varied("sense.range_m", {{"1.2"}}), varied("control.guard", {{"false"}})};
  BenchChanges changes;
  changes.set = {"sense.range_m=1.8"};

  const auto planned = plan(suite, changes);

  ASSERT_TRUE(planned.ok()) << planned.error().text();
  EXPECT_EQ(planned->variants[0].overrides.set,
            (std::vector<std::string>{"sense.range_m=1.8", "control.guard=false"}));
}

TEST(BenchPlan, AnErrorInWhatASuiteSetsIsTheSuites) {
  Suite suite = small_suite();
  suite.graphs = {"any_sensor"};
  suite.variations = {varied("sense", {{"laser"}})};
  suite.variations[0].values[0].settings = {{"rnage_m", "4"}};
  suite.variations[0].file = "mine.yaml";
  suite.variations[0].line = 7;
  suite.variations[0].column = 3;

  const auto planned = plan(suite);

  ASSERT_FALSE(planned.ok());
  EXPECT_EQ(planned.error().text().substr(0, 14), "mine.yaml:7:3:");
}

TEST(BenchPlan, WorldsAreNamedByPathsAndWildcards) {
  Suite suite = small_suite();
  const std::string worlds = tests::source_path("configs/worlds/");
  suite.worlds = {{"names", {"?-trap", "kk-fig0[78]*"}},
                  {"paths", {worlds + "lm-fig08*", worlds + "double-u.yaml"}}};

  const auto planned = plan(suite);

  ASSERT_TRUE(planned.ok()) << planned.error().text();
  std::vector<std::string> names;
  for (const BenchWorld& world : planned->worlds) names.push_back(world.name);
  const std::vector<std::string> expected = {"g-trap",
                                             "u-trap",
                                             "v-trap",
                                             "kk-fig07-clutter",
                                             "kk-fig08-right-angle-corner",
                                             worlds + "lm-fig08-clutter.yaml",
                                             worlds + "lm-fig08-u-100in.yaml",
                                             worlds + "lm-fig08-u-beyond-range.yaml",
                                             worlds + "double-u.yaml"};
  EXPECT_EQ(names, expected);
}

TEST(BenchPlan, AWorldByTwoNamesIsRefused) {
  Suite suite = small_suite();
  const std::string path = tests::source_path("configs/worlds/u-trap.yaml");
  suite.worlds = {{"names", {"u-trap"}}, {"paths", {path}}};

  const auto planned = plan(suite);

  ASSERT_FALSE(planned.ok());
  EXPECT_NE(planned.error().text().find("'u-trap' and '" + path + "' are the same world"),
            std::string::npos)
      << planned.error().text();
}

TEST(BenchPlan, WhatDecidesTheResultsIsInTheConfiguration) {
  const auto one = plan(small_suite());
  Suite longer = small_suite();
  longer.max_ticks = 100;
  BenchChanges changes;
  changes.set = {"sense.range_m=1.2"};
  const auto other = plan(longer, changes);

  ASSERT_TRUE(one.ok() && other.ok());
  EXPECT_EQ(one->configuration.at("world u-trap"), other->configuration.at("world u-trap"));
  EXPECT_NE(one->configuration.at("max_ticks"), other->configuration.at("max_ticks"));
  EXPECT_NE(one->configuration.at("graph reactive"), other->configuration.at("graph reactive"));
}

struct Refusal {
  std::string what;
  Suite suite;
  BenchChanges changes;
  std::string message;
};

TEST(BenchPlan, RefusesWhatCannotBeRun) {
  Suite unknown_graph = small_suite();
  unknown_graph.graphs = {"raective"};
  Suite unknown_world = small_suite();
  unknown_world.worlds = {{"traps", {"u-trpa"}}};
  Suite no_match = small_suite();
  no_match.worlds = {{"traps", {"xyz*"}}};
  Suite no_file = small_suite();
  no_file.worlds = {{"traps", {"./no-such-folder/*"}}};
  Suite twice = small_suite();
  twice.worlds = {{"a", {"u-trap"}}, {"b", {"u-*"}}};
  BenchChanges no_stage;
  no_stage.variations = {varied("recovr.detector", {{"none"}})};
  BenchChanges same_value;
  same_value.variations = {varied("sense.range_m", {{"1.2"}, {"1.2"}})};
  BenchChanges out_of_range;
  out_of_range.variations = {varied("sense.range_m", {{"1.5"}, {"-1"}})};
  const std::vector<Refusal> refusals = {
      {"graph", unknown_graph, {}, "did you mean 'reactive'?"},
      {"world", unknown_world, {}, "did you mean 'u-trap'?"},
      {"pattern", no_match, {}, "no world's name matches 'xyz*'"},
      {"path pattern", no_file, {}, "no .yaml file matches './no-such-folder/*'"},
      {"twice", twice, {}, "world 'u-trap' stands twice"},
      {"stage", small_suite(), no_stage, "did you mean 'recover'?"},
      {"value twice", small_suite(), same_value, "is asked for twice"},
      {"range", small_suite(), out_of_range, "krishna_kalra [sense.range_m=-1]: range_m is -1"}};

  for (const Refusal& refusal : refusals) {
    const auto planned = plan(refusal.suite, refusal.changes);

    ASSERT_FALSE(planned.ok()) << refusal.what;
    EXPECT_NE(planned.error().text().find(refusal.message), std::string::npos)
        << refusal.what << ": " << planned.error().text();
  }
}

}  // namespace
}  // namespace clew::bench

// SPDX-License-Identifier: Apache-2.0
#include "bench/suite.hpp"

#include <gtest/gtest.h>

namespace clew::bench {
namespace {

constexpr char kSuite[] = R"(format: clew-suite/1
about: "For this test."
graphs: [krishna_kalra, reactive]
vary: {recover.escape: [none, [a, b]]}
worlds: {traps: [u-trap, kk-*]}
generated: {seed: 7, count: 3, families: [u, v]}
seeds: [1, 2]
max_ticks: 500
by: [nesting, family]
)";

using Words = std::vector<std::vector<std::string>>;
using Settings = std::vector<std::pair<std::string, std::string>>;

Words words_of(const Variation& variation) {
  Words words;
  for (const auto& value : variation.values) words.push_back(value.words);
  return words;
}

core::Result<Suite> read(const std::string& text) {
  return read_suite({"suite.yaml", text}, "test");
}

TEST(Suite, IsReadWhole) {
  const auto suite = read(kSuite);

  ASSERT_TRUE(suite.ok()) << suite.error().text();
  EXPECT_EQ(suite->name, "test");
  EXPECT_EQ(suite->graphs, (std::vector<std::string>{"krishna_kalra", "reactive"}));
  ASSERT_EQ(suite->variations.size(), 1u);
  EXPECT_EQ(suite->variations[0].path, "recover.escape");
  EXPECT_EQ(words_of(suite->variations[0]), (Words{{"none"}, {"a", "b"}}));
  ASSERT_EQ(suite->worlds.size(), 1u);
  EXPECT_EQ(suite->worlds[0].second, (std::vector<std::string>{"u-trap", "kk-*"}));
  EXPECT_EQ(suite->generated.seed, 7u);
  EXPECT_EQ(suite->generated.count, 3);
  EXPECT_EQ(suite->generated.families, (std::vector<std::string>{"u", "v"}));
  EXPECT_EQ(suite->seeds, (std::vector<std::uint64_t>{1, 2}));
  EXPECT_EQ(suite->max_ticks, 500u);
  EXPECT_EQ(suite->by, (std::vector<Grouping>{Grouping::kNesting, Grouping::kFamily}));
}

TEST(Suite, GeneratesEveryFamilyIfNoneIsNamed) {
  const auto suite = read("format: clew-suite/1\ngraphs: [reactive]\ngenerated: {count: 1}\n");

  ASSERT_TRUE(suite.ok()) << suite.error().text();
  EXPECT_EQ(suite->generated.families.size(), 16u);
}

TEST(Suite, SetsParametersAlongWithABehaviour) {
  const auto suite = read(
      "format: clew-suite/1\ngraphs: [reactive]\ngenerated: {count: 1}\n"
      "vary: {sense: [cones, {laser: {range_m: 4, beams: 181}}]}\n");

  ASSERT_TRUE(suite.ok()) << suite.error().text();
  const Variation& variation = suite->variations.front();
  EXPECT_EQ(words_of(variation), (Words{{"cones"}, {"laser"}}));
  EXPECT_TRUE(variation.values[0].settings.empty());
  EXPECT_EQ(variation.values[1].settings, (Settings{{"range_m", "4"}, {"beams", "181"}}));
}

TEST(Suite, VariesOneBehaviourWithSeveralSetsOfParameters) {
  const auto suite = read(
      "format: clew-suite/1\ngraphs: [reactive]\ngenerated: {count: 1}\n"
      "vary: {sense: [{laser: {range_m: 2}}, {laser: {range_m: 4}}]}\n");

  ASSERT_TRUE(suite.ok()) << suite.error().text();
  const Variation& variation = suite->variations.front();
  EXPECT_EQ(words_of(variation), (Words{{"laser"}, {"laser"}}));
  EXPECT_EQ(variation.values[0].settings, (Settings{{"range_m", "2"}}));
  EXPECT_EQ(variation.values[1].settings, (Settings{{"range_m", "4"}}));
}

TEST(Suite, SetsValuesOfEveryGraphAsVariationsOfOneValue) {
  const auto suite = read(
      "format: clew-suite/1\ngraphs: [reactive]\ngenerated: {count: 1}\n"
      "vary: {recover.detector: [none]}\n"
      "set: {sense.range_m: 1.5, recover.escape: [a, b], sense: {laser: {range_m: 4}}}\n");

  ASSERT_TRUE(suite.ok()) << suite.error().text();
  ASSERT_EQ(suite->variations.size(), 4u);
  EXPECT_EQ(suite->variations[0].path, "sense.range_m");
  EXPECT_EQ(words_of(suite->variations[0]), (Words{{"1.5"}}));
  EXPECT_EQ(words_of(suite->variations[1]), (Words{{"a", "b"}}));
  EXPECT_EQ(suite->variations[2].values[0].settings, (Settings{{"range_m", "4"}}));
  EXPECT_EQ(suite->variations[3].path, "recover.detector");
  EXPECT_EQ(suite->variations[0].line, 5);
}

struct Refusal {
  std::string from;
  std::string to;
  std::string message;
};

class SuiteRefuses : public testing::TestWithParam<Refusal> {};

TEST_P(SuiteRefuses, WithPlaceAndWhatIsAllowed) {
  std::string text = kSuite;
  text.replace(text.find(GetParam().from), GetParam().from.size(), GetParam().to);

  const auto suite = read(text);

  ASSERT_FALSE(suite.ok());
  EXPECT_NE(suite.error().text().find(GetParam().message), std::string::npos)
      << suite.error().text();
}

INSTANTIATE_TEST_SUITE_P(
    Files, SuiteRefuses,
    testing::Values(
        Refusal{"clew-suite/1", "clew-suite/2", "suite.yaml:1"},
        Refusal{
            "graphs:", "grpahs:", "suite.yaml:3:1: unknown key 'grpahs' (did you mean 'graphs'?)"},
        Refusal{"graphs: [krishna_kalra, reactive]\n", "", "graphs"},
        Refusal{"[krishna_kalra, reactive]", "[]", "suite.yaml:3:9: the list is empty"},
        Refusal{"[krishna_kalra, reactive]", "[reactive, reactive]", "'reactive' stands twice"},
        Refusal{"count: 3", "count: 0",
                "suite.yaml:6:29: found '0', expected a whole number from 1 to 1000"},
        Refusal{"count: 3", "cuont: 3", "did you mean 'count'?"},
        Refusal{"families: [u, v]", "families: [u, sprial]",
                "unknown family 'sprial' (did you mean 'spiral'?)"},
        Refusal{"[1, 2]", "[1, 1]", "seed 1 stands twice"},
        Refusal{"[1, 2]", "[-1]", "expected a whole number from 0 to"},
        Refusal{"max_ticks: 500", "max_ticks: many", "suite.yaml:8:12"},
        Refusal{"[nesting, family]", "[nestin]",
                "suite.yaml:9:6: unknown grouping 'nestin' (did you mean 'nesting'?)"},
        Refusal{
            "worlds: {traps: [u-trap, kk-*]}\ngenerated: {seed: 7, count: 3, families: [u, v]}\n",
            "", "no worlds"},
        Refusal{"[none, [a, b]]", "[{a: {x: 1}, b: {y: 2}}]", "expected one behaviour"},
        Refusal{"[none, [a, b]]", "[]", "suite.yaml:4"},
        Refusal{"vary: {recover.escape: [none, [a, b]]}", "set: [recover.escape=none]",
                "suite.yaml:4:6: found a list of 1, expected a map"}));

TEST(Variation, IsReadFromTheCommandLine) {
  const auto variation = read_variation("recover.escape=a,b,a+b");

  ASSERT_TRUE(variation.ok());
  EXPECT_EQ(variation->path, "recover.escape");
  EXPECT_EQ(words_of(*variation), (Words{{"a"}, {"b"}, {"a", "b"}}));
}

TEST(Variation, NeedsAPathAndValues) {
  for (const char* text : {"recover.escape", "=a", "recover.escape=", "recover.escape=a,,b"}) {
    const auto variation = read_variation(text);

    ASSERT_FALSE(variation.ok()) << text;
    EXPECT_NE(variation.error().text().find("--vary"), std::string::npos) << text;
  }
}

TEST(Suite, TakesARangeOfSeeds) {
  const std::string begin =
      "format: clew-suite/1\ngraphs: [reactive]\nworlds: {open: [open-field]}\nseeds: ";
  const auto seeds_of = [&](const std::string& text) {
    return read_suite(core::Resource{"suite.yaml", begin + text + '\n'}, "test");
  };
  EXPECT_EQ(seeds_of("{first: 7, count: 3}")->seeds, (std::vector<std::uint64_t>{7, 8, 9}));
  EXPECT_EQ(seeds_of("{count: 2}")->seeds, (std::vector<std::uint64_t>{1, 2}));
  for (const auto& [text, message] : std::vector<std::pair<std::string, std::string>>{
           {"{first: 7}", "count"},
           {"{count: 0}", "suite.yaml:4:16: found '0', expected a whole number from 1 to 10000000"},
           {"{count: 2, last: 4}", "last"},
           {"{first: -1, count: 2}", "expected a whole number from 0 to "}}) {
    const auto refused = seeds_of(text);
    ASSERT_FALSE(refused.ok()) << text;
    EXPECT_NE(refused.error().text().find(message), std::string::npos) << refused.error().text();
  }
}

}  // namespace
}  // namespace clew::bench

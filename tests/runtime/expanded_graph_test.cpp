// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "fake_stages.hpp"

namespace clew::runtime {
namespace {

TEST(ExpandedGraph, HoldsEveryValueInTheOrderOfTheDeclarations) {
  EXPECT_EQ(load_good(kFullGraph).expanded_yaml(), R"(world: open-field
robot: disc-015
seed: 1
max_ticks: 20000
drive:
  behaviour: slow
sense:
  behaviour: cones
  range_m: 1.5
  count: 7
  noisy: false
  side: left
classify:
  behaviour: table
  networks: [som]
  map: ""
recover:
  detector:
    by_place:
        radius_m: 0.5
  escape:
    - follow:
        gap_m: 0.3
        patience: 9
    - wait:
        patience: 3
  shadow: []
control:
  behaviour: straight
  gain_m: 1
  guard: true
)");
}

/// The expanded text of the graph that this text describes.
std::string expanded(const std::string& text, const GraphOverrides& overrides = {}) {
  return load_good(text, overrides).expanded_yaml();
}

TEST(ExpandedGraph, LoadsAgainToTheSame) {
  GraphOverrides overrides;
  overrides.seed = 99;
  overrides.max_ticks = 5;
  overrides.world = "./my world.yaml";
  overrides.with = {"recover.shadow=by_time", "sense=ray"};
  overrides.set = {"sense.range_m=0.1", "control.guard=false", "recover.escape.wait.patience=7",
                   "classify.networks=[art, som]"};

  const std::string text = expanded(kFullGraph, overrides);

  EXPECT_EQ(expanded(text), text);
}

TEST(ExpandedGraph, KeepsNumbersToTheLastBit) {
  for (const char* value :
       {"0.1", "0.30000000000000004", "1e-1", "19.999999999999996", "2", "12.5"}) {
    GraphOverrides overrides;
    overrides.set = {std::string("sense.range_m=") + value};
    const Graph graph = load_good(kSmallGraph, overrides);

    const Graph again = load_good(graph.expanded_yaml());

    EXPECT_EQ(again.find("sense")->config.part("behaviour").parameters,
              graph.find("sense")->config.part("behaviour").parameters)
        << value;
  }
}

TEST(ExpandedGraph, KeepsTextsThatYamlCouldMistake) {
  for (const char* world :
       {"null", "Null", "NULL", "true",       "~",           "1.5",        "a: b",   "a # b",
        "- a",  "[a]",  "{a}",  "say \"hi\"", "back\\slash", "two\nlines", "a\ttab", " space ",
        "&a",   "*a",   "!a",   "%a",         "'",           "é",          ""}) {
    GraphOverrides overrides;
    overrides.world = world;
    const std::string text = expanded(kSmallGraph, overrides);

    const Graph again = load_good(text);

    EXPECT_EQ(again.world, world);
    EXPECT_EQ(again.expanded_yaml(), text);
  }
}

TEST(ExpandedGraph, DoesNotDependOnHowStagesAreDeployed) {
  const std::string spread = R"(world: open-field
robot: disc-015
start_timeout_s: 60
sense: {behaviour: cones, process: {middleware: fastdds, restart_limit: 3}}
control: {behaviour: straight}
drive: {behaviour: slow}
)";

  EXPECT_EQ(expanded(spread), expanded(kSmallGraph));
}

TEST(ExpandedGraph, NamesAComponentOfSomeoneElses) {
  const std::string text = expanded(R"(world: open-field
robot: disc-015
sense: {behaviour: cones}
control: {exec: [./my control, --flag, "2"]}
drive: {behaviour: slow}
)");

  EXPECT_NE(text.find("control:\n  exec: [\"./my control\", \"--flag\", \"2\"]\n"),
            std::string::npos)
      << text;
  EXPECT_EQ(expanded(text), text);
}

TEST(ExpandedGraph, KeepsWhoseScansASensorOfSomeoneElsesMakes) {
  const std::string text = expanded(R"(world: open-field
robot: disc-015
sense: {exec: [./my_sense], behaviour: ray, range_m: 2.5}
control: {behaviour: straight}
drive: {behaviour: slow}
)");

  EXPECT_NE(text.find("sense:\n  exec: [\"./my_sense\"]\n  behaviour: ray\n  range_m: 2.5\n"),
            std::string::npos)
      << text;
  EXPECT_EQ(expanded(text), text);
}

TEST(ExpandedGraph, KeepsTheTickOfADriveOfSomeoneElsesAndHowItIsSpokenTo) {
  const std::string text = expanded(R"(world: open-field
robot: disc-015
sense: {behaviour: cones}
control: {exec: [./my_control], via: json_lines, restart: stateless}
drive: {exec: [./my_drive], behaviour: slow}
)");

  EXPECT_NE(text.find("control:\n  exec: [\"./my_control\"]\n  via: json_lines\n"
                      "  restart: stateless\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("drive:\n  exec: [\"./my_drive\"]\n  behaviour: slow\n"), std::string::npos)
      << text;
  EXPECT_EQ(expanded(text), text);
}

}  // namespace
}  // namespace clew::runtime

// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "fake_stages.hpp"
#include "tests/source_path.hpp"

namespace clew::runtime {
namespace {

namespace fs = std::filesystem;

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

TEST(GraphFile, FillsInEveryDefault) {
  const Graph graph = load_good(kSmallGraph);

  EXPECT_EQ(graph.name, "graph");
  EXPECT_EQ(graph.world, "open-field");
  EXPECT_EQ(graph.robot, "disc-015");
  EXPECT_EQ(graph.seed, 1u);
  EXPECT_EQ(graph.max_ticks, 20000u);
  EXPECT_EQ(graph.start_timeout_s, 10.0);
  EXPECT_EQ(graph.tick_s, 0.3);
  const PartChoice& cones = graph.find("sense")->config.part("behaviour");
  EXPECT_EQ(cones.name, "cones");
  EXPECT_EQ(text_of(cones.parameters, "range_m"), "1.5");
  EXPECT_EQ(text_of(cones.parameters, "count"), "7");
  EXPECT_EQ(text_of(cones.parameters, "side"), "left");
  EXPECT_EQ(text_of(graph.find("control")->config.parameters, "guard"), "true");
}

TEST(GraphFile, PutsTheStageInThatAMissionIsShortFor) {
  const std::string graph = "world: open-field\nrobot: disc-015\nsense: {behaviour: cones}\n";
  const std::string end = "control: {behaviour: straight}\ndrive: {behaviour: slow}\n";

  EXPECT_EQ(load_good(graph + "mission: subgoals\n" + end).expanded_yaml(),
            load_good(graph + "classify: {behaviour: table}\n" + end).expanded_yaml());
  EXPECT_EQ(load_good(graph + "mission: target\n" + end).expanded_yaml(),
            load_good(graph + end).expanded_yaml());
}

TEST(GraphFile, ReadsWhatIsGiven) {
  const Graph graph = load_good(R"(about: everything
world: ./a world.yaml
robot: big
seed: 7
max_ticks: 0
start_timeout_s: 2.5
sense: {behaviour: cones, range_m: 2, noisy: true, side: right}
classify: {behaviour: table, networks: [art, som], map: office}
recover:
  detector: {by_place: {radius_m: 0.25}}
  escape:
    - follow: {gap_m: 0.1}
    - wait
  shadow: [{by_time: {ticks: 5}}, by_place]
control: {behaviour: straight, guard: false, gain_m: 0.5}
drive: {behaviour: quick}
)");

  EXPECT_EQ(graph.world, "./a world.yaml");
  EXPECT_EQ(graph.robot, "big");
  EXPECT_EQ(graph.seed, 7u);
  EXPECT_EQ(graph.max_ticks, 0u);
  EXPECT_EQ(graph.start_timeout_s, 2.5);
  EXPECT_EQ(graph.tick_s, 0.1);
  const auto& sense = graph.find("sense")->config.part("behaviour").parameters;
  EXPECT_EQ(text_of(sense, "range_m"), "2");  // a whole number is a number
  EXPECT_EQ(text_of(sense, "noisy"), "true");
  EXPECT_EQ(text_of(sense, "side"), "right");
  const auto& classify = graph.find("classify")->config.part("behaviour").parameters;
  EXPECT_EQ(text_of(classify, "networks"), "{ \"art\", \"som\" }");
  EXPECT_EQ(text_of(classify, "map"), "office");
  const StageConfig& recover = graph.find("recover")->config;
  EXPECT_EQ(text_of(recover.part("detector").parameters, "radius_m"), "0.25");
  ASSERT_EQ(recover.parts.at("escape").size(), 2u);
  EXPECT_EQ(recover.parts.at("escape")[0].name, "follow");
  EXPECT_EQ(text_of(recover.parts.at("escape")[0].parameters, "gap_m"), "0.1");
  EXPECT_EQ(text_of(recover.parts.at("escape")[0].parameters, "patience"), "9");
  EXPECT_EQ(recover.parts.at("escape")[1].name, "wait");
  EXPECT_EQ(recover.parts.at("shadow")[0].name, "by_time");
  EXPECT_EQ(text_of(recover.parts.at("shadow")[0].parameters, "ticks"), "5");
  const StageConfig& control = graph.find("control")->config;
  EXPECT_EQ(text_of(control.parameters, "guard"), "false");
  EXPECT_EQ(text_of(control.part("behaviour").parameters, "gain_m"), "0.5");
}

TEST(GraphFile, AcceptsBothEndsOfARange) {
  const std::string sense = "{behaviour: cones}";

  const Graph low = load_good(replaced(kSmallGraph, sense, "{behaviour: cones, range_m: 0.1}"));
  const Graph high = load_good(replaced(kSmallGraph, sense, "{behaviour: cones, range_m: 20.0}"));

  EXPECT_EQ(text_of(low.find("sense")->config.part("behaviour").parameters, "range_m"), "0.1");
  EXPECT_EQ(text_of(high.find("sense")->config.part("behaviour").parameters, "range_m"), "20");
}

TEST(GraphFile, AListPartMayBeEmptyOrLeftOut) {
  const Graph empty = load_good(replaced(kFullGraph, "escape: [follow, wait]", "escape: []"));
  const Graph absent = load_good(replaced(kFullGraph, ", shadow: []", ""));

  EXPECT_TRUE(empty.find("recover")->config.parts.at("escape").empty());
  EXPECT_TRUE(absent.find("recover")->config.parts.at("shadow").empty());
}

TEST(GraphFile, TheOrderOfStagesInTheFileDoesNotCount) {
  const std::string backward = R"(drive: {behaviour: slow}
control: {behaviour: straight}
sense: {behaviour: cones}
robot: disc-015
world: open-field
)";

  EXPECT_EQ(load_good(backward).expanded_yaml(), load_good(kSmallGraph).expanded_yaml());
}

TEST(GraphFile, OrdersStagesForATick) {
  const Graph graph = load_good(kFullGraph);

  std::vector<std::string> names;
  for (const GraphStage& stage : graph.stages) names.push_back(stage.info->name);

  EXPECT_EQ(names, (std::vector<std::string>{"drive", "sense", "classify", "recover", "control"}));
}

TEST(GraphFile, ListsWhatIsUnwired) {
  EXPECT_EQ(load_good(kSmallGraph).unwired, (std::vector<std::string>{"control.guidance"}));
  EXPECT_TRUE(load_good(kFullGraph).unwired.empty());
}

TEST(GraphFile, ReadsHowStagesAreDeployed) {
  const Graph graph = load_good(
      replaced(replaced(kSmallGraph, "{behaviour: cones}",
                        "{behaviour: cones, process: {middleware: fastdds, restart_limit: 3, "
                        "restart_backoff_s: 0.5, host: robot.local}}"),
               "{behaviour: straight}", "{exec: [./my control, --gain, '2'], process: {}}"));

  EXPECT_EQ(graph.find("sense")->deployment.middleware, "fastdds");
  EXPECT_EQ(graph.find("sense")->deployment.restart_limit, 3u);
  EXPECT_EQ(graph.find("sense")->deployment.restart_backoff_s, 0.5);
  EXPECT_EQ(graph.find("sense")->deployment.host, "robot.local");
  EXPECT_EQ(graph.find("drive")->deployment.host, "");
  EXPECT_EQ(graph.find("drive")->deployment.middleware, "");
  EXPECT_EQ(graph.find("drive")->deployment.restart_limit, 100u);
  EXPECT_EQ(graph.find("drive")->deployment.restart_backoff_s, 0.0);
  EXPECT_EQ(graph.find("control")->deployment.exec,
            (std::vector<std::string>{"./my control", "--gain", "2"}));
  EXPECT_TRUE(graph.find("control")->config.parts.empty());
}

TEST(GraphFile, IsNotEmpty) {
  EXPECT_EQ(refusal("# only a comment\n"), "graph.yaml: the file is empty");
}

std::vector<std::string> invalid_files() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(tests::source_path("tests/runtime/invalid"))) {
    names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

class InvalidGraphFile : public ::testing::TestWithParam<std::string> {};

/// Each file's first line is a comment with the place and the message that it must give.
TEST_P(InvalidGraphFile, IsRefusedWithTheMessageItNames) {
  std::ifstream stream(tests::source_path("tests/runtime/invalid/") + GetParam() + ".yaml");
  std::ostringstream content;
  content << stream.rdbuf();
  const std::string text = content.str();
  const std::string lead = "# refused: ";
  ASSERT_EQ(text.substr(0, lead.size()), lead);
  const std::string expected = text.substr(lead.size(), text.find('\n') - lead.size());

  EXPECT_EQ(refusal(text), "graph.yaml:" + expected);
}

/// Test names take no hyphen.
std::string test_name(const ::testing::TestParamInfo<std::string>& file) {
  std::string name = file.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Files, InvalidGraphFile, ::testing::ValuesIn(invalid_files()), test_name);

}  // namespace
}  // namespace clew::runtime

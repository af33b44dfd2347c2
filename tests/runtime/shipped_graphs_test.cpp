// SPDX-License-Identifier: Apache-2.0
/// The graphs and robots in configs/, with the stages that ship.
#include <gtest/gtest.h>

#include <algorithm>

#include "runtime/composed_executor.hpp"
#include "runtime/run_plan.hpp"
#include "stages/all.hpp"
#include "tests/source_path.hpp"

namespace clew::runtime {
namespace {

ConfigPath configs() { return ConfigPath({tests::source_path("configs")}); }

/// Test names take no hyphen.
std::string test_name(const ::testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

class ShippedGraph : public ::testing::TestWithParam<std::string> {
 protected:
  RunPlan plan() const {
    auto plan = prepare_run(GetParam(), {}, configs(), stages::all());
    EXPECT_TRUE(plan.ok()) << plan.error().text();
    return std::move(plan).value();
  }
};

TEST_P(ShippedGraph, PassesTheCheck) {
  const RunPlan checked = plan();

  EXPECT_EQ(checked.graph.name, GetParam());
  EXPECT_NE(checked.graph.writer_of(Topic::kCommand), nullptr);
}

TEST_P(ShippedGraph, IsTheSameGraphWhenItsBundleIsRead) {
  const RunPlan first = plan();

  const auto again = prepare_run(first.bundle, stages::all());

  ASSERT_TRUE(again.ok()) << again.error().text();
  EXPECT_EQ(again->bundle, first.bundle);
}

TEST_P(ShippedGraph, WritesEverySampleOfEveryTick) {
  const RunPlan checked = plan();
  ComposedExecutor executor(make_nodes(checked).value(), nullptr);

  for (int tick = 0; tick < 10; ++tick) executor.step();

  for (const GraphStage& stage : checked.graph.stages) {
    for (Topic topic : stage.ports.output_order) {
      domain::visit_topic(topic, [&](auto constant) {
        const auto& message = std::get<index_of(decltype(constant)::value)>(executor.messages());
        EXPECT_EQ(message.stamp.tick, 9u) << domain::topic_name(topic);
        EXPECT_EQ(message.stamp.sequence, 9u) << domain::topic_name(topic);
        const auto valid = domain::validate(message);
        EXPECT_TRUE(valid.ok()) << valid.error().text();
      });
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Configs, ShippedGraph, ::testing::ValuesIn(configs().names("graphs")),
                         test_name);

class ShippedRobot : public ::testing::TestWithParam<std::string> {};

TEST_P(ShippedRobot, IsReadAndNamedLikeItsFile) {
  const auto file = configs().find("robots", GetParam());

  const auto robot = read_robot(*file, "");

  ASSERT_TRUE(robot.ok()) << robot.error().text();
  EXPECT_EQ(robot->name, GetParam());
}

INSTANTIATE_TEST_SUITE_P(Configs, ShippedRobot, ::testing::ValuesIn(configs().names("robots")),
                         test_name);

TEST(MissionOfAGraph, IsShortForThePlannerAlongTheWorldsSubgoals) {
  const std::string head = "world: lm-fig09-office\nrobot: disc-015\n";
  const std::string stages =
      "sense: {behaviour: cones}\ncontrol: {behaviour: krishna_kalra_fuzzy}\n"
      "drive: {behaviour: turn_then_step}\n";
  const auto load = [](const std::string& text) {
    return load_graph({"g.yaml", text}, "g", {}, stages::all());
  };

  const auto said = load(head + "mission: subgoals\n" + stages);
  const auto meant = load(head + "plan: {behaviour: world_subgoals}\n" + stages);
  const auto both = load(head + "mission: subgoals\nplan: {behaviour: neural_map}\n" + stages);

  ASSERT_TRUE(said.ok()) << said.error().text();
  ASSERT_TRUE(meant.ok()) << meant.error().text();
  EXPECT_EQ(said->expanded_yaml(), meant->expanded_yaml());
  ASSERT_FALSE(both.ok());
  EXPECT_EQ(both.error().line, 3);
}

}  // namespace
}  // namespace clew::runtime

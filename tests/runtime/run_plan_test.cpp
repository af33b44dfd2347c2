// SPDX-License-Identifier: Apache-2.0
#include "runtime/run_plan.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "fake_stages.hpp"
#include "world/world.hpp"

namespace clew::runtime {
namespace {

constexpr char kWorld[] = R"(format: clew-world/1
name: made-up
bounds: [0, 0, 10, 10]
start: [1, 1, 0]
target: [9, 9]
target_radius: 0.2
)";
constexpr char kRobot[] = "{format: clew-robot/1, name: disc-020, radius_m: 0.2}";

/// What a run of the full graph is made of, its table with a data file.
Bundle full_bundle() {
  std::string graph = kFullGraph;
  const std::string table = "{behaviour: table}";
  graph.replace(graph.find(table), table.size(), "{behaviour: table, map: office}");
  return {{"graph.yaml", graph},
          {"world.yaml", kWorld},
          {"robot.yaml", kRobot},
          {"rulebases/office.yaml", "rooms: 3"}};
}

Bundle small_bundle() {
  return {{"graph.yaml", kSmallGraph}, {"world.yaml", kWorld}, {"robot.yaml", kRobot}};
}

RunPlan prepare_good(const Bundle& bundle, const GraphOverrides& overrides = {}) {
  auto plan = prepare_run("graph", overrides, BundleSource(bundle), fake_stages());
  EXPECT_TRUE(plan.ok()) << plan.error().text();
  return std::move(plan).value();
}

std::string refused_run(const Bundle& bundle, const GraphOverrides& overrides = {}) {
  const auto plan = prepare_run("graph", overrides, BundleSource(bundle), fake_stages());
  return plan.ok() ? "accepted" : plan.error().text();
}

TEST(RunPlan, IsReadForOneStageAsFarAsItNeedsIt) {
  const Bundle bundle = prepare_good(full_bundle()).bundle;
  Bundle without_world = bundle;
  without_world["world.yaml"] = "walls: [";

  const auto sense = read_prepared_run(bundle, fake_stages(), "sense");
  const auto control = read_prepared_run(without_world, fake_stages(), "control");
  const auto drive = read_prepared_run(without_world, fake_stages(), "drive");

  ASSERT_TRUE(sense.ok() && control.ok());
  EXPECT_EQ(sense->setup.world->name(), "made-up");
  EXPECT_TRUE(make_node(*sense, *sense->graph.find("sense")).ok());
  EXPECT_EQ(control->setup.world, nullptr);
  EXPECT_TRUE(make_node(*control, *control->graph.find("control")).ok());
  EXPECT_FALSE(drive.ok());
}

TEST(RunPlan, GathersWhatARunIsAFunctionOf) {
  GraphOverrides overrides;
  overrides.seed = 5;
  overrides.max_ticks = 100;

  const RunPlan plan = prepare_good(full_bundle(), overrides);

  EXPECT_EQ(plan.setup.seed, 5u);
  EXPECT_EQ(plan.setup.max_ticks, 100u);
  EXPECT_EQ(plan.setup.world->name(), "made-up");
  EXPECT_EQ(plan.setup.behaviour.robot.name, "disc-020");
  EXPECT_EQ(plan.setup.behaviour.robot.radius_m, 0.2);
  EXPECT_EQ(plan.setup.behaviour.tick_s, 0.3);
  EXPECT_EQ(plan.setup.behaviour.scan.sensor, "cones");
  EXPECT_EQ(plan.setup.behaviour.resources.find("rulebases", "office")->text, "rooms: 3");
}

TEST(RunPlan, NamesWorldAndRobotAsTheirFilesDo) {
  GraphOverrides overrides;
  overrides.world = "./somewhere/else.yaml";
  overrides.robot = "/a/robot.yaml";

  const RunPlan plan = prepare_good(small_bundle(), overrides);

  EXPECT_EQ(plan.graph.world, "made-up");
  EXPECT_EQ(plan.graph.robot, "disc-020");
}

TEST(RunPlan, ItsBundleGivesTheSamePlan) {
  GraphOverrides overrides;
  overrides.seed = 5;
  overrides.with = {"sense=ray"};
  overrides.set = {"recover.escape.wait.patience=8"};
  const RunPlan plan = prepare_good(full_bundle(), overrides);

  const auto again = prepare_run(plan.bundle, fake_stages());

  ASSERT_TRUE(again.ok()) << again.error().text();
  EXPECT_EQ(again->bundle, plan.bundle);
  EXPECT_EQ(again->graph.expanded_yaml(), plan.graph.expanded_yaml());
  EXPECT_EQ(again->setup.seed, 5u);
  EXPECT_EQ(again->setup.behaviour.scan.sensor, "ray");
}

TEST(RunPlan, ItsBundleHoldsTheFilesOfItsBehavioursOnly) {
  Bundle bundle = full_bundle();
  bundle["rulebases/unused.yaml"] = "";

  const RunPlan plan = prepare_good(bundle);

  std::vector<std::string> names;
  for (const auto& [name, text] : plan.bundle) names.push_back(name);
  EXPECT_EQ(names, (std::vector<std::string>{"graph.yaml", "robot.yaml", "rulebases/office.yaml",
                                             "world.yaml"}));
}

TEST(RunPlan, MakesANodeForEachStageInOrder) {
  const RunPlan plan = prepare_good(small_bundle());

  const auto nodes = make_nodes(plan);

  ASSERT_TRUE(nodes.ok());
  ASSERT_EQ(nodes->size(), 3u);
  EXPECT_EQ((*nodes)[0].name(), "drive");
  EXPECT_EQ((*nodes)[1].name(), "sense");
  EXPECT_EQ((*nodes)[2].name(), "control");
  EXPECT_TRUE((*nodes)[2].ports().inputs[index_of(Topic::kTarget)]);
}

TEST(RunPlan, RefusesWhatIsNotThere) {
  const std::map<std::string, std::string> places = {
      {"graph.yaml", ""},
      {"world.yaml", "graph.yaml:1:8: "},
      {"robot.yaml", "graph.yaml:2:8: "},
      {"rulebases/office.yaml", "graph.yaml:4:35: "}};
  for (const auto& [name, place] : places) {
    Bundle bundle = full_bundle();
    bundle.erase(name);

    EXPECT_EQ(refused_run(bundle), place + "the bundle has no " + name);
  }
}

TEST(RunPlan, SaysOfAnOptionWhatItNamesThatIsNotThere) {
  Bundle bundle = small_bundle();
  bundle.erase("world.yaml");
  GraphOverrides overrides;
  overrides.world = "u-tarp";

  EXPECT_EQ(refused_run(bundle, overrides), "--world: the bundle has no world.yaml");
}

TEST(RunPlan, SaysWhereAGraphNamesAFileThatIsWrong) {
  Bundle bundle = full_bundle();
  bundle["rulebases/office.yaml"] = "wrong";

  EXPECT_EQ(refused_run(bundle),
            "graph.yaml:4:35: map: rulebases/office.yaml:1:1: wrong is no map");
}

TEST(RunPlan, RefusesABadWorld) {
  Bundle bundle = small_bundle();
  bundle["world.yaml"] = "format: clew-world/1\n";

  EXPECT_EQ(refused_run(bundle), "world.yaml:1:1: missing key 'name'");
}

TEST(RunPlan, RefusesARobotThatDoesNotFitAtTheStart) {
  Bundle bundle = small_bundle();
  bundle["robot.yaml"] = "{format: clew-robot/1, radius_m: 1.5}";

  // The start is 1 m from two sides of the boundary.
  const std::string refused = refused_run(bundle);

  EXPECT_NE(refused.find("a robot of radius 1.5 m does not fit at the start [1, 1]"),
            std::string::npos)
      << refused;
  EXPECT_EQ(refused.find("world.yaml:"), 0u) << refused;
}

TEST(RunPlan, PassesOnWhatAComponentRefuses) {
  GraphOverrides overrides;
  overrides.seed = 13;

  EXPECT_EQ(refused_run(small_bundle(), overrides),
            "graph.yaml:5:8: drive: drive does not like 13");
}

TEST(RunPlan, AComponentOfSomeoneElsesCannotBeComposed) {
  Bundle bundle = small_bundle();
  std::string& graph = bundle["graph.yaml"];
  const std::string control = "{behaviour: straight}";
  graph.replace(graph.find(control), control.size(), "{exec: [./my_control]}");

  const RunPlan plan = prepare_good(bundle);

  EXPECT_EQ(make_nodes(plan).error().text(),
            "graph.yaml:4:10: control has exec: a third-party component is a process, and "
            "cannot be composed");
}

TEST(RunPlan, ASensorOfSomeoneElsesIsKnownByTheBehaviourBesideIt) {
  Bundle bundle = small_bundle();
  std::string& graph = bundle["graph.yaml"];
  const std::string sense = "{behaviour: cones}";
  graph.replace(graph.find(sense), sense.size(), "{exec: [./my_sense], behaviour: cones}");
  GraphOverrides overrides;
  overrides.with = {"sense=ray"};

  const RunPlan plan = prepare_good(bundle, overrides);
  const auto again = prepare_run(plan.bundle, fake_stages());

  EXPECT_EQ(plan.setup.behaviour.scan.sensor, "ray");
  ASSERT_TRUE(again.ok()) << again.error().text();
  EXPECT_EQ(again->setup.behaviour.scan.sensor, "ray");
}

TEST(RobotFile, HasARadiusAndPerhapsAName) {
  const auto named = read_robot({"a.yaml", kRobot}, "given");
  const auto nameless =
      read_robot({"a.yaml", "{format: clew-robot/1, about: small, radius_m: 0.01}"}, "given");

  EXPECT_EQ(named->name, "disc-020");
  EXPECT_EQ(named->radius_m, 0.2);
  EXPECT_EQ(nameless->name, "given");
  EXPECT_EQ(nameless->radius_m, 0.01);
}

TEST(RobotFile, IsRefusedWithItsPlace) {
  const auto refused = [](const std::string& text) {
    const auto robot = read_robot({"a.yaml", text}, "given");
    return robot.ok() ? "accepted" : robot.error().text();
  };

  EXPECT_EQ(refused(""), "a.yaml: the file is empty");
  EXPECT_EQ(refused("radius_m: 0.2"), "a.yaml:1:1: missing key 'format', expected clew-robot/1");
  EXPECT_EQ(refused("{format: clew-robot/2, radius_m: 0.2}"),
            "a.yaml:1:10: found 'clew-robot/2', expected clew-robot/1");
  EXPECT_EQ(refused("{format: [clew-robot/1], radius_m: 0.2}"),
            "a.yaml:1:10: found a list of 1, expected clew-robot/1");
  EXPECT_EQ(refused("format: clew-robot/1"), "a.yaml:1:1: missing key 'radius_m'");
  EXPECT_EQ(refused("{format: clew-robot/1, raduis_m: 0.2}"),
            "a.yaml:1:24: unknown key 'raduis_m' (did you mean 'radius_m'?); allowed: format, "
            "name, about, radius_m");
  EXPECT_EQ(refused("{format: clew-robot/1, radius_m: 0.2 m}"),
            "a.yaml:1:34: found '0.2 m', expected a finite number");
  EXPECT_EQ(refused("{format: clew-robot/1, radius_m: 0}"),
            "a.yaml:1:34: radius_m is '0'; allowed: 0.01 to 5 m");
  EXPECT_EQ(refused("{format: clew-robot/1, radius_m: 5.1}"),
            "a.yaml:1:34: radius_m is '5.1'; allowed: 0.01 to 5 m");
  EXPECT_EQ(refused("{format: clew-robot/1, name: [a], radius_m: 1}"),
            "a.yaml:1:30: found a list of 1, expected a text");
}

}  // namespace
}  // namespace clew::runtime

// SPDX-License-Identifier: Apache-2.0
/// Changes of a run that goes on: what is allowed, and whose place is taken.
#include "runtime/intervention.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "fake_stages.hpp"
#include "runtime/config_source.hpp"

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

Bundle bundle_of(std::string graph, const std::string& what = {}, const std::string& with = {}) {
  if (!what.empty()) graph.replace(graph.find(what), what.size(), with);
  return {{"graph.yaml", graph}, {"world.yaml", kWorld}, {"robot.yaml", kRobot}};
}

RunPlan plan_of(const Bundle& bundle, const std::vector<StageInfo>& stages = fake_stages()) {
  auto plan = prepare_run("graph", {}, BundleSource(bundle), stages);
  EXPECT_TRUE(plan.ok()) << plan.error().text();
  return std::move(plan).value();
}

RunPlan full_plan() {
  Bundle bundle = bundle_of(kFullGraph, "{behaviour: table}", "{behaviour: table, map: office}");
  bundle["rulebases/office.yaml"] = "rooms: 3";
  return plan_of(bundle);
}

/// Data files beside the run.
const Bundle& other_files() {
  static const Bundle files = {{"rulebases/attic.yaml", "rooms: 1"},
                               {"rulebases/bad.yaml", "wrong"}};
  return files;
}

/// Why a run of this plan cannot be changed so; `allowed` if it can.
std::string answer(const RunPlan& before, const std::vector<std::string>& changes,
                   const std::vector<StageInfo>& stages = fake_stages()) {
  Intervention intervention = planned_at(100, changes);
  const auto after = change(before, BundleSource(other_files()), stages, intervention);
  return after.ok() ? "allowed" : after.error().text();
}

TEST(Intervention, IsReadWithItsTick) {
  const auto read = read_intervention("700:control.behaviour=curved", "--at");
  ASSERT_TRUE(read.ok()) << read.error().text();
  EXPECT_EQ(read->tick, 700u);
  EXPECT_EQ(read->fed_from, 700u - kFedTicks);
  EXPECT_EQ(read->changes, std::vector<std::string>{"control.behaviour=curved"});
  EXPECT_EQ(read_intervention("7:goal=1,2", "--at")->fed_from, 0u);

  for (const std::string text : {"", "7", "7:", ":goal=1,2", "-7:goal=1,2", "7 goal=1,2"}) {
    EXPECT_EQ(read_intervention(text, "--at").error().text(),
              "--at: found '" + text +
                  "'; expected TICK:STAGE.PART=NAME, TICK:STAGE.PARAM=VALUE or TICK:goal=X,Y");
  }
  EXPECT_EQ(read_intervention("0:goal=1,2", "--at").error().text(),
            "--at: tick 0 is where the run begins: change the graph itself, with --with or --set");
}

TEST(Intervention, ChangesBehavioursParametersAndTheGoal) {
  const RunPlan before = plan_of(bundle_of(kSmallGraph));
  Intervention intervention =
      planned_at(100, {"control.behaviour=curved", "control.guard=false", "goal=3,4,0.5"});

  const auto after = change(before, BundleSource(other_files()), fake_stages(), intervention);

  ASSERT_TRUE(after.ok()) << after.error().text();
  const StageConfig& control = after->graph.find("control")->config;
  EXPECT_EQ(control.part("behaviour").name, "curved");
  EXPECT_EQ(text_of(control.parameters, "guard"), "false");
  ASSERT_EQ(after->setup.world->waypoints().size(), 1u);
  EXPECT_EQ(after->setup.world->waypoints()[0].place, core::Vec2(3.0, 4.0));
  EXPECT_EQ(after->graph.name, before.graph.name);
  EXPECT_TRUE(intervention.files.empty());
}

TEST(Intervention, NotesDataFilesThatAreNewAndKeepsThoseOfBefore) {
  const RunPlan before = full_plan();
  Intervention intervention = planned_at(100, {"classify.map=attic"});

  const auto after = change(before, BundleSource(other_files()), fake_stages(), intervention);

  ASSERT_TRUE(after.ok()) << after.error().text();
  EXPECT_EQ(intervention.files,
            (std::map<std::string, std::string>{{"rulebases/attic.yaml", "rooms: 1"}}));
  EXPECT_EQ(after->bundle.count("rulebases/office.yaml"), 1u) << "a later change may go back";
  EXPECT_EQ(answer(*after, {"classify.map=office"}), "allowed");
}

TEST(Intervention, RefusesWhatIsNoChangeOfThisRun) {
  const RunPlan plan = full_plan();
  const std::map<std::string, std::vector<std::string>> answers = {
      {"found 'control'; allowed: STAGE.PART=NAME, STAGE.PARAM=VALUE or goal=X,Y", {"control"}},
      {"the goal is given twice; once is allowed", {"goal=1,2", "goal=3,4"}},
      {"that is as it is already: nothing would change", {"control.behaviour=straight"}},
      {"drive is the robot: while it drives, only its goal can be changed",
       {"drive.behaviour=quick"}}};
  for (const auto& [expected, changes] : answers) EXPECT_EQ(answer(plan, changes), expected);
  EXPECT_NE(answer(plan, {"goal=far"}), "allowed");
  EXPECT_NE(answer(plan, {"control.behaviour=bent"}).find("bent"), std::string::npos);
  EXPECT_NE(answer(plan, {"classify.map=cellar"}), "allowed") << "there is no such file";
  EXPECT_NE(answer(plan, {"classify.map=bad"}).find("wrong is no map"), std::string::npos);
}

TEST(Intervention, RefusesToChangeAComponentOfSomebodyElse) {
  const RunPlan foreign =
      plan_of(bundle_of(kSmallGraph, "{behaviour: slow}", "{exec: [./robot], behaviour: slow}"));
  const RunPlan own = plan_of(bundle_of(kSmallGraph));

  EXPECT_EQ(answer(foreign, {"goal=1,2"}),
            "drive is a component of someone else's: its goal cannot be changed from here");
  EXPECT_EQ(answer(own, {"goal=1,2"}), "allowed");
}

TEST(Intervention, RefusesOtherBeamsUnderStagesThatStay) {
  std::vector<StageInfo> stages = fake_stages();
  stages[0].scan_layout = [](const StageConfig& config) {
    domain::ScanLayout layout;
    layout.sensor = config.part("behaviour").name;
    layout.beam_count = layout.sensor == "ray" ? 1 : 7;
    return layout;
  };
  const RunPlan plan = plan_of(bundle_of(kSmallGraph), stages);

  EXPECT_EQ(answer(plan, {"sense.behaviour=ray"}, stages),
            "the scan would have other beams, those of ray instead of cones: the other stages were "
            "made for these");
  EXPECT_EQ(answer(plan, {"sense.range_m=2.5"}, stages), "allowed");
}

TEST(Intervention, RefusesAnotherTick) {
  std::vector<StageInfo> stages = fake_stages();
  stages[4].tick_s = [](const StageConfig&) { return 0.0; };
  stages[0].tick_s = [](const StageConfig& config) {
    return config.part("behaviour").name == "ray" ? 0.2 : 0.3;
  };
  const RunPlan plan = plan_of(bundle_of(kSmallGraph), stages);

  EXPECT_EQ(answer(plan, {"sense.behaviour=ray"}, stages),
            "a tick would last 0.2 s instead of 0.3 s");
}

TEST(Intervention, TakesThePlaceOfWhatItChangesAlone) {
  const RunPlan first = plan_of(bundle_of(kSmallGraph));
  const std::vector<Intervention> interventions = {planned_at(600, {"control.behaviour=curved"}),
                                                   {650, 650, {}, "pause", {}},
                                                   planned_at(700, {"goal=3,4"})};
  const auto plans = change_all(first, interventions, fake_stages());
  ASSERT_TRUE(plans.ok()) << plans.error().text();
  ASSERT_EQ(plans->size(), 3u);
  EXPECT_EQ((*plans)[0], (*plans)[1]) << "a pause changes no plan";

  auto successions = make_successions(first, interventions, *plans);

  ASSERT_TRUE(successions.ok()) << successions.error().text();
  std::map<std::string, std::vector<std::uint64_t>> ticks;
  for (const NodeSuccession& node : *successions) {
    for (const Successor& next : node.successors()) {
      ticks[node.name()].push_back(next.tick);
      EXPECT_EQ(next.keeps_state, node.name() == "drive");
      EXPECT_EQ(next.fed_from, next.tick - kFedTicks);
      EXPECT_EQ(next.make().name(), node.name());
    }
  }
  EXPECT_EQ(ticks, (std::map<std::string, std::vector<std::uint64_t>>{{"control", {600}},
                                                                      {"drive", {700}}}));
}

TEST(Intervention, IsReadForOneStageFromWhatTheRunHas) {
  const RunPlan first = full_plan();
  Intervention planned = planned_at(600, {"classify.map=attic"});
  ASSERT_TRUE(change(first, BundleSource(other_files()), fake_stages(), planned).ok());

  const auto plans = change_all(first, {planned}, fake_stages(), "classify");
  ASSERT_TRUE(plans.ok()) << plans.error().text();
  EXPECT_TRUE(successor(first, plans->at(0), planned, "classify").has_value());
  EXPECT_FALSE(successor(first, plans->at(0), planned, "control").has_value());

  planned.files.clear();
  const auto without = change_all(first, {planned}, fake_stages());
  ASSERT_FALSE(without.ok());
  EXPECT_NE(without.error().text().find("the run has no file 'attic' of rulebases"),
            std::string::npos)
      << without.error().text();
}

}  // namespace
}  // namespace clew::runtime

// SPDX-License-Identifier: Apache-2.0
/// What --world, --robot, --seed, --max-ticks, --with and --set change in a graph, and their
/// errors.
#include <gtest/gtest.h>

#include <limits>

#include "fake_stages.hpp"

namespace clew::runtime {
namespace {

GraphOverrides with(std::vector<std::string> texts) {
  GraphOverrides overrides;
  overrides.with = std::move(texts);
  return overrides;
}

GraphOverrides set(std::vector<std::string> texts) {
  GraphOverrides overrides;
  overrides.set = std::move(texts);
  return overrides;
}

std::vector<std::string> names(const Graph& graph, const std::string& stage,
                               const std::string& part) {
  std::vector<std::string> names;
  for (const PartChoice& choice : graph.find(stage)->config.parts.at(part)) {
    names.push_back(choice.name);
  }
  return names;
}

/// A parameter of the behaviour of a stage.
std::string behaviour_value(const Graph& graph, const std::string& stage, const std::string& name) {
  return text_of(graph.find(stage)->config.part("behaviour").parameters, name);
}

constexpr char kTunedGraph[] = R"(world: open-field
robot: disc-015
sense: {behaviour: cones, range_m: 2.5, count: 5}
recover:
  detector: {by_time: {ticks: 20}}
  escape: [{follow: {gap_m: 0.1}}, {wait: {patience: 4}}]
control: {behaviour: straight, guard: false, gain_m: 2}
drive: {behaviour: slow}
)";

TEST(Overrides, OfTheHeadReplaceWhatTheFileSays) {
  GraphOverrides overrides;
  overrides.world = "u-trap";
  overrides.robot = "big";
  overrides.seed = 12;
  overrides.max_ticks = 0;

  const Graph graph = load_good(kSmallGraph, overrides);

  EXPECT_EQ(graph.world, "u-trap");
  EXPECT_EQ(graph.robot, "big");
  EXPECT_EQ(graph.seed, 12u);
  EXPECT_EQ(graph.max_ticks, 0u);
}

TEST(Overrides, OfCountsStopAtWhatAGraphFileHolds) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::int64_t>::max();
  GraphOverrides most;
  most.seed = kMost;
  GraphOverrides seed;
  seed.seed = kMost + 1;
  GraphOverrides max_ticks;
  max_ticks.max_ticks = kMost + 1;

  EXPECT_EQ(load_good(kSmallGraph, most).seed, kMost);
  EXPECT_EQ(refusal(kSmallGraph, seed),
            "--seed: found 9223372036854775808; allowed: 0 to 9223372036854775807");
  EXPECT_EQ(refusal(kSmallGraph, max_ticks),
            "--max-ticks: found 9223372036854775808; allowed: 0 to 9223372036854775807");
}

TEST(With, SwapsABehaviour) {
  const Graph graph = load_good(kSmallGraph, with({"sense=ray", "control.behaviour=curved"}));

  EXPECT_EQ(names(graph, "sense", "behaviour"), (std::vector<std::string>{"ray"}));
  EXPECT_EQ(names(graph, "control", "behaviour"), (std::vector<std::string>{"curved"}));
}

TEST(With, LeavesTheOldBehavioursParametersBehind) {
  const Graph graph = load_good(kTunedGraph, with({"sense=ray", "control=curved"}));

  EXPECT_EQ(behaviour_value(graph, "sense", "range_m"),
            "3");  // its own default, not the cones' 2.5
  EXPECT_EQ(behaviour_value(graph, "sense", "count"), "absent");
  EXPECT_EQ(behaviour_value(graph, "control", "order"), "2");
  EXPECT_EQ(text_of(graph.find("control")->config.parameters, "guard"),
            "false");  // the stage's own
}

TEST(With, KeepsTheParametersOfABehaviourThatStays) {
  const Graph graph = load_good(kTunedGraph, with({"sense=cones", "recover.escape=wait,follow"}));

  EXPECT_EQ(behaviour_value(graph, "sense", "range_m"), "2.5");
  EXPECT_EQ(names(graph, "recover", "escape"), (std::vector<std::string>{"wait", "follow"}));
  const auto& escapes = graph.find("recover")->config.parts.at("escape");
  EXPECT_EQ(text_of(escapes[0].parameters, "patience"), "4");
  EXPECT_EQ(text_of(escapes[1].parameters, "gap_m"), "0.1");
}

TEST(With, FillsAListThatWasEmpty) {
  const Graph graph = load_good(kFullGraph, with({"recover.shadow=by_time,by_place"}));

  EXPECT_EQ(names(graph, "recover", "shadow"), (std::vector<std::string>{"by_time", "by_place"}));
}

TEST(With, ChoosesAPartOnce) {
  EXPECT_EQ(refusal(kSmallGraph, with({"sense=ray", "sense.behaviour=cones"})),
            "--with sense.behaviour: is given twice; once is allowed");
  EXPECT_EQ(refusal(kFullGraph, with({"recover.escape=wait", "recover.escape=follow"})),
            "--with recover.escape: is given twice; once is allowed");
  EXPECT_EQ(refusal(kFullGraph, with({"recover.escape=wait", "recover.shadow=by_time"})),
            "accepted");
}

TEST(With, IsRefusedWhereItMakesNoSense) {
  const auto refused = [](const std::string& text) { return refusal(kFullGraph, with({text})); };

  EXPECT_EQ(refused("sense"), "--with: expected a name, '=' and a value; found 'sense'");
  EXPECT_EQ(refused("=cones"), "--with: expected a name, '=' and a value; found '=cones'");
  EXPECT_EQ(refused("sense="), "--with sense: no value after '='");
  EXPECT_EQ(refused("sens=ray"),
            "--with sens: unknown stage of this graph 'sens' (did you mean 'sense'?); allowed: "
            "sense, classify, recover, control, drive");
  EXPECT_EQ(refused("sense=rya"),
            "--with sense: unknown sense behaviour 'rya' (did you mean 'ray'?); allowed: cones, "
            "ray");
  EXPECT_EQ(refused("recover.detecter=by_time"),
            "--with recover.detecter: unknown part of recover 'detecter' (did you mean "
            "'detector'?); allowed: detector, escape, shadow");
  EXPECT_EQ(refused("recover=by_time"),
            "--with recover: unknown part of recover 'behaviour'; allowed: detector, escape, "
            "shadow");
  EXPECT_EQ(refused("recover.escape.follow=wait"),
            "--with recover.escape.follow: expected STAGE[.PART]=NAME[,NAME...], found "
            "'recover.escape.follow=wait'");
  EXPECT_EQ(refused("sense=cones,ray"), "--with sense: sense.behaviour takes one name, found 2");
  EXPECT_EQ(refused("recover.escape=wait,follow,wait"),
            "--with recover.escape: 'wait' stands twice in the list of escape");
  EXPECT_EQ(refused("recover.escape=wait,,follow"),
            "--with recover.escape: unknown recover escape ''; allowed: follow, wait");
}

TEST(With, IsRefusedForAStageThatIsNotInTheGraph) {
  EXPECT_EQ(refusal(kSmallGraph, with({"recover.detector=by_time"})),
            "--with recover.detector: unknown stage of this graph 'recover'; allowed: sense, "
            "control, drive");
}

TEST(With, IsRefusedForAPartThatMissesATopic) {
  EXPECT_EQ(refusal(kTunedGraph, with({"recover.detector=by_place"})),
            "graph.yaml:5:3: recover.detector 'by_place' needs 'landmark', and no stage of this "
            "graph writes it");
}

TEST(Set, ChangesParametersOfStageAndBehaviour) {
  const Graph graph = load_good(
      kTunedGraph, set({"sense.range_m=4", "control.guard=true", "control.behaviour.gain_m=0.5",
                        "sense.behaviour.cones.side=right"}));

  EXPECT_EQ(behaviour_value(graph, "sense", "range_m"), "4");
  EXPECT_EQ(behaviour_value(graph, "sense", "count"), "5");
  EXPECT_EQ(behaviour_value(graph, "sense", "side"), "right");
  EXPECT_EQ(text_of(graph.find("control")->config.parameters, "guard"), "true");
  EXPECT_EQ(behaviour_value(graph, "control", "gain_m"), "0.5");
}

TEST(Set, ChangesParametersOfPartsByNameOrAlone) {
  const Graph graph =
      load_good(kTunedGraph, set({"recover.detector.ticks=30", "recover.escape.wait.patience=8",
                                  "recover.escape.gap_m=0.2"}));

  EXPECT_EQ(text_of(graph.find("recover")->config.part("detector").parameters, "ticks"), "30");
  const auto& escapes = graph.find("recover")->config.parts.at("escape");
  EXPECT_EQ(text_of(escapes[0].parameters, "gap_m"), "0.2");  // only follow has a gap_m
  EXPECT_EQ(text_of(escapes[0].parameters, "patience"), "9");
  EXPECT_EQ(text_of(escapes[1].parameters, "patience"), "8");
}

TEST(Set, GivesAParameterOnce) {
  const std::string twice = "is given twice; once is allowed";

  EXPECT_EQ(refusal(kSmallGraph, set({"sense.range_m=4", "sense.range_m=5"})),
            "--set sense.range_m: " + twice);
  EXPECT_EQ(refusal(kSmallGraph, set({"sense.range_m=4", "sense.behaviour.range_m=4"})),
            "--set sense.behaviour.range_m: " + twice);
  EXPECT_EQ(
      refusal(kFullGraph, set({"recover.escape.gap_m=0.1", "recover.escape.follow.gap_m=0.2"})),
      "--set recover.escape.follow.gap_m: " + twice);
  EXPECT_EQ(refusal(kFullGraph,
                    set({"recover.escape.follow.patience=4", "recover.escape.wait.patience=4"})),
            "accepted");
}

TEST(Set, TakesListsAndTexts) {
  const Graph graph =
      load_good(kFullGraph, set({"classify.networks=[art, som]", "classify.map=new-map"}));

  EXPECT_EQ(behaviour_value(graph, "classify", "networks"), "{ \"art\", \"som\" }");
  EXPECT_EQ(behaviour_value(graph, "classify", "map"), "new-map");
}

TEST(Set, ComesAfterWith) {
  GraphOverrides overrides = with({"sense=ray"});
  overrides.set = {"sense.range_m=9"};

  const Graph graph = load_good(kTunedGraph, overrides);

  EXPECT_EQ(behaviour_value(graph, "sense", "range_m"), "9");
}

TEST(Set, IsRefusedWhereItMakesNoSense) {
  const auto refused = [](const std::string& text) { return refusal(kFullGraph, set({text})); };

  EXPECT_EQ(refused("sense.range_m"),
            "--set: expected a name, '=' and a value; found 'sense.range_m'");
  EXPECT_EQ(refused("sense.range_m="), "--set sense.range_m: no value after '='");
  EXPECT_EQ(refused("sense=4"),
            "--set sense: expected STAGE[.PART][.NAME].PARAM=VALUE, found 'sense=4'");
  EXPECT_EQ(refused("a.b.c.d.e=4"),
            "--set a.b.c.d.e: unknown stage of this graph 'a'; allowed: sense, classify, recover, "
            "control, drive");
  EXPECT_EQ(refused("recover.escape.wait.patience.x=4"),
            "--set recover.escape.wait.patience.x: expected STAGE[.PART][.NAME].PARAM=VALUE, found "
            "'recover.escape.wait.patience.x=4'");
  EXPECT_EQ(refused("sens.range_m=4"),
            "--set sens.range_m: unknown stage of this graph 'sens' (did you mean 'sense'?); "
            "allowed: sense, classify, recover, control, drive");
  EXPECT_EQ(refused("sense.rnage_m=4"),
            "--set sense.rnage_m: unknown parameter of sense 'rnage_m' (did you mean 'range_m'?); "
            "allowed: range_m, count, noisy, side");
  EXPECT_EQ(refused("recover.escapes.gap_m=4"),
            "--set recover.escapes.gap_m: unknown part of recover 'escapes' (did you mean "
            "'escape'?); allowed: detector, escape, shadow");
  EXPECT_EQ(refused("sense.behaviour=ray"),
            "--set sense.behaviour: 'behaviour' is no parameter; choose it by --with "
            "sense.behaviour=NAME");
  EXPECT_EQ(refused("sense.exec=[./a]"), "--set sense.exec: 'exec' is no parameter");
}

TEST(Set, NamesTheParameterOfAPartThatWasMeant) {
  const auto refused = [](const std::string& text) { return refusal(kFullGraph, set({text})); };

  EXPECT_EQ(refused("recover.gap=0.2"),
            "--set recover.gap: unknown parameter of recover 'gap' (did you mean "
            "'recover.escape.gap_m'?); 'clew list recover' tells all");
  EXPECT_EQ(refused("recover.radus_m=0.2"),
            "--set recover.radus_m: unknown parameter of recover 'radus_m' (did you mean "
            "'recover.detector.radius_m'?); 'clew list recover' tells all");
}

TEST(Set, GivesAProcessItsSettings) {
  const auto graph = load_fake(
      kFullGraph, set({"control.process.middleware=fastdds", "control.process.restart_limit=7"}));

  ASSERT_TRUE(graph.ok()) << graph.error().text();
  EXPECT_EQ(graph->find("control")->deployment.middleware, "fastdds");
  EXPECT_EQ(graph->find("control")->deployment.restart_limit, 7u);
  EXPECT_EQ(refusal(kFullGraph, set({"control.process.middleware=opendds"})).substr(0, 34),
            "--set control.process.middleware: ");
  EXPECT_EQ(refusal(kFullGraph, set({"control.process.midleware=fastdds"})),
            "--set control.process.midleware: unknown setting of process 'midleware' (did you mean "
            "'middleware'?); allowed: middleware, restart_limit, restart_backoff_s, group, host");
}

TEST(Set, IsRefusedForABehaviourThatWasNotChosen) {
  EXPECT_EQ(refusal(kFullGraph, set({"sense.behaviour.ray.range_m=4"})),
            "--set sense.behaviour.ray.range_m: unknown chosen behaviour 'ray'; allowed: cones");
  EXPECT_EQ(refusal(kFullGraph, set({"recover.escape.folow.gap_m=0.2"})),
            "--set recover.escape.folow.gap_m: unknown chosen escape 'folow' (did you mean "
            "'follow'?); allowed: follow, wait");
  EXPECT_EQ(refusal(kFullGraph, set({"recover.shadow.by_time.ticks=4"})),
            "--set recover.shadow.by_time.ticks: unknown chosen shadow 'by_time'; none is allowed "
            "here");
}

TEST(Set, IsRefusedWhereItCouldMeanSeveral) {
  EXPECT_EQ(refusal(kFullGraph, set({"recover.escape.patience=4"})),
            "--set recover.escape.patience: 2 of the chosen escape have a parameter 'patience'; "
            "name one as recover.escape.NAME.patience");
  EXPECT_EQ(refusal(kFullGraph, set({"recover.escape.speed=4"})),
            "--set recover.escape.speed: 0 of the chosen escape have a parameter 'speed'; name one "
            "as recover.escape.NAME.speed");
}

TEST(Set, ChecksValuesAsTheFilesAreChecked) {
  const auto refused = [](const std::string& text) { return refusal(kFullGraph, set({text})); };

  EXPECT_EQ(refused("sense.range_m=far"),
            "--set sense.range_m: range_m: found 'far', expected a finite number");
  EXPECT_EQ(refused("sense.range_m=20.5"),
            "--set sense.range_m: range_m is 20.5; allowed: 0.1 to 20 m");
  EXPECT_EQ(refused("recover.detector.tick=4"),
            "--set recover.detector.tick: unknown parameter of recover.detector.by_place "
            "'tick'; allowed: radius_m");
  EXPECT_EQ(refused("classify.networks=[som"),
            "--set classify.networks: broken YAML: end of sequence flow not found");
}

TEST(Overrides, OfAComponentOfSomeoneElsesAreRefused) {
  const std::string graph = R"(world: open-field
robot: disc-015
sense: {behaviour: cones}
control: {exec: [./my_control]}
drive: {behaviour: slow}
)";
  const std::string expected =
      "graph.yaml:4:10: control has exec: a third-party component takes no behaviour and no "
      "parameters here";

  EXPECT_EQ(refusal(graph, with({"control=straight"})), expected);
  EXPECT_EQ(refusal(graph, set({"control.guard=false"})), expected);
}

}  // namespace
}  // namespace clew::runtime

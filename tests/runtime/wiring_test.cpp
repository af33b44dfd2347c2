// SPDX-License-Identifier: Apache-2.0
#include "runtime/wiring.hpp"

#include <gtest/gtest.h>

#include <deque>

#include "runtime/on_demand.hpp"

namespace clew::runtime {
namespace {

/// A graph of stages that have nothing but a name and ports.
class Wiring : public ::testing::Test {
 protected:
  void add(const std::string& name, std::vector<PortInfo> ports, std::vector<PartInfo> parts = {},
           const std::map<std::string, std::vector<PartChoice>>& chosen = {}) {
    infos_.push_back({name, "", std::move(ports), {}, std::move(parts), nullptr, nullptr, nullptr});
    graph_.stages.push_back({&infos_.back(), {name, {}, chosen}, {}, {}, {}, {}});
  }
  /// Wires the graph: `wired`, or the error.
  std::string wire_it() {
    const auto wired = wire(graph_);
    return wired.ok() ? "wired" : wired.error().text();
  }
  std::vector<std::string> order() const {
    std::vector<std::string> names;
    for (const GraphStage& stage : graph_.stages) names.push_back(stage.info->name);
    return names;
  }

  std::deque<StageInfo> infos_;  // stages point into it
  Graph graph_;
};

using Names = std::vector<std::string>;

TEST_F(Wiring, OrdersStagesByWhatTheyRead) {
  add("control", {required_input(Topic::kScan, ""), output(Topic::kCommand, "")});
  add("sense", {required_input(Topic::kState, ""), output(Topic::kScan, "")});
  add("drive", {delayed_input(Topic::kCommand, ""), output(Topic::kState, "")});

  EXPECT_EQ(wire_it(), "wired");

  EXPECT_EQ(order(), (Names{"drive", "sense", "control"}));
}

TEST_F(Wiring, KeepsTheOrderOfStagesThatDoNotDependOnEachOther) {
  add("drive", {output(Topic::kState, "")});
  add("sense", {required_input(Topic::kState, ""), output(Topic::kScan, "")});
  add("watch", {required_input(Topic::kState, ""), output(Topic::kEvent, "")});

  EXPECT_EQ(wire_it(), "wired");

  EXPECT_EQ(order(), (Names{"drive", "sense", "watch"}));
}

TEST_F(Wiring, WhoReadsTheTickBeforeRunsBeforeItsWriter) {
  // Otherwise the sample of this tick would have replaced it already.
  add("control", {output(Topic::kCommand, "")});
  add("watch", {delayed_input(Topic::kCommand, ""), output(Topic::kEvent, "")});

  EXPECT_EQ(wire_it(), "wired");

  EXPECT_EQ(order(), (Names{"watch", "control"}));
}

TEST_F(Wiring, ConnectsWritersAndReaders) {
  add("drive", {delayed_input(Topic::kCommand, ""), output(Topic::kState, "")});
  add("sense", {required_input(Topic::kState, ""), output(Topic::kScan, "")});
  add("control", {required_input(Topic::kScan, ""), required_input(Topic::kState, ""),
                  output(Topic::kCommand, "")});

  EXPECT_EQ(wire_it(), "wired");

  EXPECT_EQ(graph_.writer_of(Topic::kState)->info->name, "drive");
  EXPECT_EQ(graph_.writer_of(Topic::kLandmark), nullptr);
  const auto readers = graph_.readers_of(Topic::kState);
  ASSERT_EQ(readers.size(), 2u);
  EXPECT_EQ(readers[0]->info->name, "sense");
  EXPECT_EQ(readers[1]->info->name, "control");
  EXPECT_EQ(graph_.readers_of(Topic::kCommand).front()->info->name, "drive");
  EXPECT_EQ(graph_.find("sense")->info->name, "sense");
  EXPECT_EQ(graph_.find("plan"), nullptr);
}

TEST_F(Wiring, RefusesTwoWritersOfATopic) {
  add("sense", {output(Topic::kScan, "")});
  add("lidar", {output(Topic::kScan, "")});

  EXPECT_EQ(wire_it(), "'scan' has two writers: sense and lidar");
}

TEST_F(Wiring, LeavesAFallbackOutputToAnotherWriter) {
  add("drive", {output(Topic::kState, ""), fallback_output(Topic::kTarget, "")});
  add("plan", {required_input(Topic::kState, ""), output(Topic::kTarget, "")});

  EXPECT_EQ(wire_it(), "wired");

  EXPECT_EQ(graph_.writer_of(Topic::kTarget)->info->name, "plan");
  EXPECT_EQ(graph_.find("drive")->ports.output_order, std::vector<Topic>{Topic::kState});
}

TEST_F(Wiring, KeepsAFallbackOutputWithoutAnotherWriter) {
  add("drive", {fallback_output(Topic::kTarget, "")});

  EXPECT_EQ(wire_it(), "wired");

  EXPECT_EQ(graph_.writer_of(Topic::kTarget)->info->name, "drive");
}

TEST_F(Wiring, RefusesTwoFallbackWritersOfATopic) {
  add("drive", {fallback_output(Topic::kTarget, "")});
  add("watch", {fallback_output(Topic::kTarget, "")});

  EXPECT_EQ(wire_it(), "'target' has two writers: drive and watch");
}

TEST_F(Wiring, RefusesARequiredInputThatNobodyWrites) {
  add("control", {required_input(Topic::kScan, ""), output(Topic::kCommand, "")});

  EXPECT_EQ(wire_it(), "control needs 'scan', and no stage of this graph writes it");
}

TEST_F(Wiring, RefusesADelayedInputThatNobodyWrites) {
  add("drive", {delayed_input(Topic::kCommand, ""), output(Topic::kState, "")});

  EXPECT_EQ(wire_it(), "drive needs 'command', and no stage of this graph writes it");
}

TEST_F(Wiring, NotesOptionalInputsThatNobodyWrites) {
  add("recover", {optional_input(Topic::kLandmark, ""), optional_input(Topic::kScan, ""),
                  output(Topic::kGuidance, "")});

  EXPECT_EQ(wire_it(), "wired");

  EXPECT_EQ(graph_.unwired, (Names{"recover.landmark", "recover.scan"}));
  EXPECT_TRUE(graph_.stages[0].ports.inputs.none());
}

TEST_F(Wiring, AFallbackIsNeededOnlyIfTheFirstChoiceIsNotWritten) {
  const std::vector<PortInfo> control = {optional_input(Topic::kGuidance, ""),
                                         fallback_input(Topic::kTarget, Topic::kGuidance, ""),
                                         output(Topic::kCommand, "")};
  add("recover", {output(Topic::kGuidance, "")});
  add("control", control);

  EXPECT_EQ(wire_it(), "wired");
  EXPECT_TRUE(graph_.unwired.empty());

  graph_.stages.erase(graph_.stages.begin());
  EXPECT_EQ(wire_it(), "control needs 'target', and no stage of this graph writes it");
}

TEST_F(Wiring, RefusesACycleWithinATick) {
  add("drive", {output(Topic::kState, "")});
  add("plan", {required_input(Topic::kGuidance, ""), output(Topic::kTarget, "")});
  add("recover", {required_input(Topic::kTarget, ""), output(Topic::kGuidance, "")});

  EXPECT_EQ(wire_it(),
            "these stages wait for one another within a tick: plan, recover; only an input of the "
            "tick before may close a cycle");
}

TEST_F(Wiring, RefusesAStageThatReadsItsOwnOutput) {
  add("plan", {required_input(Topic::kTarget, ""), output(Topic::kTarget, "")});

  EXPECT_EQ(wire_it(),
            "these stages wait for one another within a tick: plan; only an input of the tick "
            "before may close a cycle");
}

TEST_F(Wiring, RefusesAPartThatMissesATopicAndNamesBothSides) {
  const VariantInfo by_place{"by_place", "", {}, TopicSet().set(index_of(Topic::kLandmark))};
  const VariantInfo by_time{"by_time", "", {}, {}};
  const std::vector<PortInfo> ports = {optional_input(Topic::kLandmark, ""),
                                       output(Topic::kGuidance, "")};
  const std::vector<PartInfo> parts = {{"detector", false, {by_place, by_time}},
                                       {"shadow", true, {by_place, by_time}}};

  add("recover", ports, parts, {{"detector", {{"by_time", {}}}}, {"shadow", {}}});
  EXPECT_EQ(wire_it(), "wired");

  graph_.stages[0].config.parts["shadow"] = {{"by_time", {}}, {"by_place", {}}};
  EXPECT_EQ(wire_it(),
            "recover.shadow 'by_place' needs 'landmark', and no stage of this graph writes it");

  add("classify", {output(Topic::kLandmark, "")});
  EXPECT_EQ(wire_it(), "wired");
}

TEST_F(Wiring, WiresAnInputOnDemandOnlyForABehaviourThatNeedsIt) {
  const VariantInfo heeds{"heeds", "", {}, TopicSet().set(index_of(Topic::kLandmark))};
  add("classify", {output(Topic::kLandmark, "")});
  add("control", {on_demand_input(Topic::kLandmark, ""), output(Topic::kCommand, "")},
      {{"reaction", true, {heeds}}}, {{"reaction", {}}});

  EXPECT_EQ(wire_it(), "wired");
  EXPECT_TRUE(graph_.readers_of(Topic::kLandmark).empty());

  graph_.stages[1].config.parts["reaction"] = {{"heeds", {}}};
  EXPECT_EQ(wire_it(), "wired");
  ASSERT_EQ(graph_.readers_of(Topic::kLandmark).size(), 1u);
  EXPECT_EQ(graph_.readers_of(Topic::kLandmark).front()->info->name, "control");
}

TEST_F(Wiring, RefusesABehaviourWhoseInputOnDemandNobodyWrites) {
  const VariantInfo heeds{"heeds", "", {}, TopicSet().set(index_of(Topic::kLandmark))};
  add("control", {on_demand_input(Topic::kLandmark, ""), output(Topic::kCommand, "")},
      {{"reaction", true, {heeds}}}, {{"reaction", {{"heeds", {}}}}});

  EXPECT_EQ(wire_it(),
            "control.reaction 'heeds' needs 'landmark', and no stage of this graph writes it");
  EXPECT_TRUE(graph_.unwired.empty());
}

}  // namespace
}  // namespace clew::runtime

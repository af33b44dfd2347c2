// SPDX-License-Identifier: Apache-2.0
#include "runtime/node.hpp"

#include <gtest/gtest.h>

#include "fake_stages.hpp"

namespace clew::runtime {
namespace {

TopicSet set_of(std::initializer_list<Topic> topics) {
  TopicSet set;
  for (Topic topic : topics) set.set(index_of(topic));
  return set;
}

const StageInfo& fake(const std::string& name) {
  for (const StageInfo& stage : fake_stages()) {
    if (stage.name == name) return stage;
  }
  throw std::out_of_range(name);
}

TEST(Ports, ReadOptionalInputsThatSomebodyWrites) {
  const NodePorts alone = resolve_ports(fake("recover"), set_of({Topic::kOdometry}));
  const NodePorts wired =
      resolve_ports(fake("recover"), set_of({Topic::kOdometry, Topic::kLandmark}));

  EXPECT_EQ(alone.inputs, set_of({Topic::kOdometry}));
  EXPECT_EQ(wired.inputs, set_of({Topic::kOdometry, Topic::kLandmark}));
  EXPECT_EQ(alone.declared_inputs, wired.inputs);
}

TEST(Ports, ReadAFallbackOnlyInsteadOfWhatNobodyWrites) {
  const NodePorts with_guidance =
      resolve_ports(fake("control"), set_of({Topic::kOdometry, Topic::kTarget, Topic::kGuidance}));
  const NodePorts without =
      resolve_ports(fake("control"), set_of({Topic::kOdometry, Topic::kTarget}));

  EXPECT_EQ(with_guidance.inputs, set_of({Topic::kOdometry, Topic::kGuidance}));
  EXPECT_EQ(without.inputs, set_of({Topic::kOdometry, Topic::kTarget}));
}

TEST(Ports, KeepDelayedInputsApart) {
  const NodePorts ports = resolve_ports(fake("drive"), set_of({Topic::kCommand}));

  EXPECT_TRUE(ports.inputs.none());
  EXPECT_EQ(ports.delayed_inputs, set_of({Topic::kCommand}));
  EXPECT_EQ(ports.all_inputs(), set_of({Topic::kCommand}));
}

TEST(Ports, KeepTheOrderOfTheOutputs) {
  const NodePorts ports = resolve_ports(fake("drive"), {});

  EXPECT_EQ(ports.output_order,
            (std::vector<Topic>{Topic::kState, Topic::kOdometry, Topic::kTarget}));
  EXPECT_EQ(ports.outputs, set_of({Topic::kState, Topic::kOdometry, Topic::kTarget}));
}

/// Reads odometry and, if it is there, landmark; writes the sum of what it read so far.
class Summer : public Component {
 public:
  void step(const TickInputs& inputs, TickOutputs& outputs) override {
    sum_ += inputs.get<domain::Odometry>().speed_mps;
    if (inputs.find<domain::Landmark>() != nullptr) sum_ += 100.0;
    if (sum_ > 5.0) outputs.get<domain::Guidance>().target_x_m = sum_;
    last_tick_ = inputs.tick();
  }
  void save(core::StateWriter& writer) const override {
    double sum = sum_;
    std::uint64_t last_tick = last_tick_;
    writer(sum, last_tick);
  }
  void load(core::StateReader& reader) override { reader(sum_, last_tick_); }

 private:
  double sum_ = 0.0;
  std::uint64_t last_tick_ = 0;
};

constexpr double kTick_s = 0.25;

Node make_summer() {
  return Node("recover", resolve_ports(fake("recover"), set_of({Topic::kOdometry})),
              std::make_unique<Summer>(), kTick_s);
}

const domain::Guidance& step(Node& node, std::uint64_t tick, double speed_mps,
                             domain::Messages& messages) {
  std::get<domain::Odometry>(messages).speed_mps = speed_mps;
  node.step(tick, node.ports().inputs, messages);
  return std::get<domain::Guidance>(messages);
}

TEST(Node, StampsItsOutputs) {
  Node node = make_summer();
  domain::Messages messages;

  step(node, 4, 1.0, messages);
  const domain::Guidance& guidance = step(node, 5, 1.0, messages);

  EXPECT_EQ(guidance.stamp.tick, 5u);
  EXPECT_EQ(guidance.stamp.sim_time_s, 1.25);  // 5 ticks of 0.25 s
  EXPECT_EQ(guidance.stamp.sequence, 1u);      // the second sample
  EXPECT_EQ(std::get<domain::Event>(messages).stamp.sequence, 1u);
}

TEST(Node, OutputsSayNothingUnlessWritten) {
  Node node = make_summer();
  domain::Messages messages;
  std::get<domain::Guidance>(messages).target_x_m = 7.0;  // of an earlier tick

  EXPECT_EQ(step(node, 0, 1.0, messages).target_x_m, 0.0);  // a sum of 1 is not written
  EXPECT_EQ(step(node, 1, 9.0, messages).target_x_m, 10.0);
}

TEST(Node, DoesNotShowWhatIsNotPresent) {
  Node node = make_summer();
  domain::Messages messages;

  // Landmark is declared, and a sample of somebody's lies there, but it is not wired.
  const domain::Guidance& guidance = step(node, 0, 6.0, messages);

  EXPECT_EQ(guidance.target_x_m, 6.0);
}

TEST(Node, GoesOnFromASavedState) {
  Node whole = make_summer();
  Node restarted = make_summer();
  domain::Messages messages;
  step(whole, 0, 6.0, messages);

  const auto loaded = restarted.load(whole.save());

  ASSERT_TRUE(loaded.ok());
  const domain::Guidance expected = step(whole, 1, 2.0, messages);
  const domain::Guidance& guidance = step(restarted, 1, 2.0, messages);
  EXPECT_EQ(guidance.target_x_m, 8.0);
  EXPECT_EQ(guidance.target_x_m, expected.target_x_m);
  EXPECT_EQ(guidance.stamp.sequence, 1u);
  EXPECT_EQ(restarted.save(), whole.save());
}

TEST(Node, RefusesAStateThatIsNotItsOwn) {
  Node node = make_summer();
  const std::string bytes = node.save();

  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(node.load(bytes.substr(0, size)).ok()) << size;
  }
  // Eight counters and the two fields of a Summer: 80 bytes.
  EXPECT_EQ(
      node.load(bytes + '\0').error().text(),
      "the saved state of recover is not one of this component: it is too long, byte 80 of 81");
}

TEST(NodeDeathTest, ReadingOrWritingAnUndeclaredTopicAborts) {
  const domain::Messages messages;
  domain::Messages written;
  const TopicSet odometry = set_of({Topic::kOdometry});
  const TickInputs inputs(messages, odometry, {}, 0);
  TickOutputs outputs(written, odometry);

  EXPECT_DEATH(inputs.find<domain::Scan>(), "scan is not a declared input");
  EXPECT_DEATH(inputs.get<domain::Odometry>(), "odometry is not present");
  EXPECT_DEATH(outputs.get<domain::Scan>(), "scan is not a declared output");
}

TEST(StageConfigDeathTest, HasExactlyOneOfAPartThatIsNoList) {
  const StageConfig config{"recover", {}, {{"escape", {{"follow", {}}, {"wait", {}}}}}};

  EXPECT_DEATH(config.part("escape"), "recover has not exactly one escape");
  EXPECT_DEATH(config.part("detector"), "recover has not exactly one detector");
}

}  // namespace
}  // namespace clew::runtime

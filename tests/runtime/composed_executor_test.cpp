// SPDX-License-Identifier: Apache-2.0
#include "runtime/composed_executor.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "domain/topics.hpp"

namespace clew::runtime {
namespace {

/// A component of one function and one number.
class Lambda : public Component {
 public:
  using Step = std::function<void(const TickInputs&, TickOutputs&)>;
  explicit Lambda(Step step) : step_(std::move(step)) {}
  void step(const TickInputs& inputs, TickOutputs& outputs) override { step_(inputs, outputs); }
  void save(core::StateWriter&) const override {}
  void load(core::StateReader&) override {}

 private:
  Step step_;
};

/// Drive writes odometry k + 1 from command k; control answers each odometry with twice its speed.
std::vector<Node> make_loop(std::vector<std::string>& log) {
  NodePorts drive_ports;
  drive_ports.delayed_inputs.set(index_of(Topic::kCommand));
  drive_ports.declared_inputs = drive_ports.delayed_inputs;
  drive_ports.outputs.set(index_of(Topic::kOdometry));
  drive_ports.output_order = {Topic::kOdometry};
  NodePorts control_ports;
  control_ports.inputs.set(index_of(Topic::kOdometry));
  control_ports.declared_inputs = control_ports.inputs;
  control_ports.outputs.set(index_of(Topic::kCommand));
  control_ports.output_order = {Topic::kCommand};

  std::vector<Node> nodes;
  nodes.emplace_back(
      "drive", drive_ports,
      std::make_unique<Lambda>([&log](const TickInputs& inputs, TickOutputs& outputs) {
        const auto* command = inputs.find<domain::Command>();
        log.push_back(command == nullptr
                          ? "drive without command"
                          : "drive with command " + std::to_string(command->stamp.tick));
        outputs.get<domain::Odometry>().speed_mps =
            command == nullptr ? 1.0 : command->motion.speed_mps + 1.0;
      }),
      0.1);
  nodes.emplace_back(
      "control", control_ports,
      std::make_unique<Lambda>([&log](const TickInputs& inputs, TickOutputs& outputs) {
        const auto& odometry = inputs.get<domain::Odometry>();
        log.push_back("control with odometry " + std::to_string(odometry.stamp.tick));
        outputs.get<domain::Command>().motion.speed_mps = 2.0 * odometry.speed_mps;
      }),
      0.1);
  return nodes;
}

TEST(ComposedExecutor, RunsEveryNodeOnceATick) {
  std::vector<std::string> log;
  ComposedExecutor executor(make_loop(log), nullptr);

  executor.step();
  executor.step();

  EXPECT_EQ(log, (std::vector<std::string>{"drive without command", "control with odometry 0",
                                           "drive with command 0", "control with odometry 1"}));
  EXPECT_EQ(executor.next_tick(), 2u);
}

TEST(ComposedExecutor, PassesValuesRoundTheLoop) {
  std::vector<std::string> log;
  ComposedExecutor executor(make_loop(log), nullptr);

  for (int tick = 0; tick < 3; ++tick) executor.step();

  // Odometry 1, 3, 7: twice the one before, and one more; commands are twice these.
  EXPECT_EQ(std::get<domain::Odometry>(executor.messages()).speed_mps, 7.0);
  EXPECT_EQ(std::get<domain::Command>(executor.messages()).motion.speed_mps, 14.0);
  EXPECT_EQ(std::get<domain::Command>(executor.messages()).stamp.tick, 2u);
  EXPECT_EQ(std::get<domain::Command>(executor.messages()).stamp.sequence, 2u);
}

TEST(ComposedExecutor, GoesOnFromTheMiddleOfARun) {
  std::vector<std::string> log;
  ComposedExecutor whole(make_loop(log), nullptr);
  std::vector<Node> nodes = make_loop(log);
  ComposedExecutor first(make_loop(log), nullptr);
  for (int tick = 0; tick < 3; ++tick) whole.step();
  first.step();
  first.step();
  // The samples of a tick lie with the executor, the counts of the outputs with the nodes.
  std::vector<Node> stepped = make_loop(log);
  domain::Messages scratch;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (std::uint64_t tick = 0; tick < 2; ++tick) {
      stepped[i].step(tick, stepped[i].ports().inputs, scratch);
    }
    ASSERT_TRUE(nodes[i].load(stepped[i].save()).ok());
  }

  ComposedExecutor rest(alone(std::move(nodes)), nullptr, 2, first.messages());
  rest.step();

  const auto& expected = std::get<domain::Command>(whole.messages());
  const auto& command = std::get<domain::Command>(rest.messages());
  EXPECT_EQ(rest.next_tick(), 3u);
  EXPECT_EQ(command.motion.speed_mps, expected.motion.speed_mps);
  EXPECT_EQ(command.stamp.sequence, expected.stamp.sequence);
}

class TopicLog : public SampleObserver {
 public:
  void on_output(Topic topic, const domain::Messages& messages) override {
    const std::uint64_t tick = domain::visit_topic(topic, [&](auto constant) {
      return std::get<index_of(decltype(constant)::value)>(messages).stamp.tick;
    });
    seen.push_back(std::string(domain::topic_name(topic)) + ' ' + std::to_string(tick));
  }
  std::vector<std::string> seen;
};

TEST(ComposedExecutor, ShowsEachSampleOnceInTheOrderOfWriting) {
  std::vector<std::string> log;
  TopicLog observer;
  ComposedExecutor executor(make_loop(log), &observer);

  executor.step();
  executor.step();

  EXPECT_EQ(observer.seen,
            (std::vector<std::string>{"odometry 0", "command 0", "odometry 1", "command 1"}));
}

}  // namespace
}  // namespace clew::runtime

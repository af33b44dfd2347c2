// SPDX-License-Identifier: Apache-2.0
#include "component/command_gate.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>

#include "component/process_host.hpp"
#include "fake_participant.hpp"
#include "line/user_data.hpp"
#include "wire/codec.hpp"

namespace clew::bridge {
namespace {

using domain::Topic;
using std::chrono::milliseconds;

std::string passed(CommandGate& gate, int commands) {
  std::string passes;
  for (int i = 0; i < commands; ++i) passes += gate.lets_pass() ? 'x' : '-';
  return passes;
}

TEST(CommandGate, LetsEveryCommandPassUnlessItIsToldOtherwise) {
  CommandGate gate;

  EXPECT_EQ(passed(gate, 4), "xxxx");
}

TEST(CommandGate, HalvesUntilItIsToldToStop) {
  CommandGate gate;

  gate.halve(true);
  EXPECT_EQ(passed(gate, 5), "x-x-x");
  gate.halve(false);
  EXPECT_EQ(passed(gate, 3), "xxx");
}

TEST(CommandGate, StaysShutWhateverBecomesOfTheSpeedUntilItIsOpened) {
  CommandGate gate;
  gate.halve(true);
  gate.shut();

  gate.halve(false);
  EXPECT_EQ(passed(gate, 3), "---");
  EXPECT_TRUE(gate.is_shut());
  gate.open();
  EXPECT_EQ(passed(gate, 3), "xxx");
}

TEST(CommandGate, IsOpenedForAllCommands) {
  CommandGate gate;
  gate.halve(true);

  gate.open();

  EXPECT_EQ(passed(gate, 3), "xxx");
}

runtime::TopicSet only(Topic topic) { return runtime::TopicSet().set(domain::index_of(topic)); }

/// Drives as a drive does, and notes in which ticks it had a command.
class NotedDrive : public runtime::Component {
 public:
  explicit NotedDrive(std::string& had) : had_(had) {}
  void step(const runtime::TickInputs& inputs, runtime::TickOutputs&) override {
    had_ += inputs.find<domain::Command>() == nullptr ? '-' : 'x';
  }
  void save(core::StateWriter&) const override {}
  void load(core::StateReader&) override {}

 private:
  std::string& had_;
};

/// A drive in real time on a clock of the test, whose commands are never late.
class DrivenInTime : public testing::Test {
 protected:
  DrivenInTime()
      : control_(remote(true, "command", "control",
                        UserData{std::string(idl_fingerprint()), "control"}.to_text())),
        barrier_("drive", {{"command", true, "control", false}},
                 {[] {}, [](const auto&) {}, [](const auto&) {}}) {
    plan_.graph.tick_s = 0.1;
    barrier_.on_matched(control_);
    runtime::NodePorts ports;
    ports.declared_inputs = ports.delayed_inputs = only(Topic::kCommand);
    ports.outputs = only(Topic::kState);
    ports.output_order = {Topic::kState};
    std::vector<runtime::NodeSuccession> nodes;
    nodes.emplace_back(
        runtime::Node("drive", std::move(ports), std::make_unique<NotedDrive>(had_), 0.1));
    Assignment assignment;
    assignment.pace = Pace::kRealtime;
    assignment.lead = UINT64_MAX;
    host_ = std::make_unique<ProcessHost>(
        std::move(nodes), assignment, plan_,
        NodeHost::Handlers{[](const auto&) {}, [](const auto&) {}, [](const auto&) {},
                           [](const auto&) {}, [](const auto&) {}});
    EXPECT_TRUE(host_->open(participant_, barrier_).ok());
    host_->go(now_);
  }
  /// Lets so many ticks begin, each with the command of the tick before.
  void drive(int ticks) {
    for (; ticks > 0; --ticks) {
      domain::Command command;
      command.stamp = {tick_, 0.1 * static_cast<double>(tick_), tick_};
      Codec<domain::Command> codec;
      participant_.deliver("command", std::string(codec.encode(command)), &control_);
      ++tick_;
      now_ += milliseconds(100);
      host_->poll(now_);
    }
  }

  // Ahead of the clock, so that nothing but the test lets a tick begin.
  NodeHost::Time now_ = std::chrono::steady_clock::now() + std::chrono::hours(1);
  std::uint64_t tick_ = 0;
  std::string had_;  ///< tick by tick
  runtime::RunPlan plan_;
  FakeParticipant participant_;
  RemoteEndpoint control_;
  StartBarrier barrier_;
  std::unique_ptr<ProcessHost> host_;
};

TEST_F(DrivenInTime, TakesEverySecondCommandWhileItIsToGoSlowly) {
  drive(2);
  host_->slow(true);
  drive(4);
  host_->slow(false);
  drive(2);

  EXPECT_EQ(had_, "-xxx-x-xx");
}

TEST_F(DrivenInTime, RestsUntilItIsReleasedThoughTheSensorIsFreshAgain) {
  drive(1);
  host_->slow(true);
  host_->rest();
  host_->slow(false);
  drive(3);
  host_->release(now_);
  ++tick_;  // one begins at once
  drive(2);

  EXPECT_EQ(had_, "-x----xx");
}

}  // namespace
}  // namespace clew::bridge

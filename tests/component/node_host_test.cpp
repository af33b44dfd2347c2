// SPDX-License-Identifier: Apache-2.0
#include "component/node_host.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "fake_participant.hpp"
#include "line/user_data.hpp"
#include "wire/codec.hpp"

namespace clew::bridge {
namespace {

using domain::Topic;
using Texts = std::vector<std::string>;
using Time = NodeHost::Time;

std::string data_of(const std::string& stage) {
  return UserData{std::string(idl_fingerprint()), stage}.to_text();
}

runtime::TopicSet only(Topic topic) { return runtime::TopicSet().set(domain::index_of(topic)); }

/// Answers a target with a command that holds the target's x, and counts its steps in its state.
class Echo : public runtime::Component {
 public:
  void step(const runtime::TickInputs& inputs, runtime::TickOutputs& outputs) override {
    ++steps_;
    domain::Motion& motion = outputs.get<domain::Command>().motion;
    motion.kind = domain::CommandKind::kTurnAndStep;
    motion.step_m = inputs.get<domain::Target>().x_m;
  }
  void save(core::StateWriter& writer) const override {
    std::uint64_t steps = steps_;
    writer(steps);
  }
  void load(core::StateReader& reader) override { reader(steps_); }

 private:
  std::uint64_t steps_ = 0;
};

runtime::Node echo_node() {
  runtime::NodePorts ports;
  ports.inputs = ports.declared_inputs = only(Topic::kTarget);
  ports.outputs = only(Topic::kCommand);
  ports.output_order = {Topic::kCommand};
  return runtime::Node("echo", std::move(ports), std::make_unique<Echo>(), 0.1);
}

std::string target_of(std::uint64_t tick) {
  domain::Target target;
  target.stamp = {tick, 0.1 * static_cast<double>(tick), tick};
  target.x_m = 0.01 * static_cast<double>(tick);
  target.radius_m = 0.2;
  Codec<domain::Target> codec;
  return std::string(codec.encode(target));
}

class Host : public testing::Test {
 protected:
  Host()
      : writer_(remote(true, "target", "plan", data_of("plan"))),
        barrier_("echo", {{"target", true, "plan", false}}, {[] {}, [](auto) {}, [](auto) {}}) {
    plan_.graph.tick_s = 0.1;
    barrier_.on_matched(writer_);
  }

  NodeHost& make(Assignment assignment = {}) {
    host_ = std::make_unique<NodeHost>(
        runtime::NodeSuccession(echo_node()), assignment, plan_,
        NodeHost::Handlers{[this](std::string text) { notices_.push_back(std::move(text)); },
                           [this](std::string text) { fatal_.push_back(std::move(text)); },
                           [this](const Progress& progress) { progress_.push_back(progress); },
                           [this](const Checkpoint& one) { checkpoints_.push_back(one); },
                           [this](std::string spool) { spooled_ += spool; }, nullptr,
                           [this](const domain::Incident& one) { incidents_.push_back(one); }});
    EXPECT_TRUE(host_->open(participant_, barrier_).ok());
    return *host_;
  }
  void deliver(std::uint64_t tick) { participant_.deliver("target", target_of(tick), &writer_); }
  Texts commands() const { return participant_.written("command"); }
  static domain::Command decoded(const std::string& cdr) {
    Codec<domain::Command> codec;
    domain::Command command;
    EXPECT_TRUE(codec.decode(cdr, command).ok());
    return command;
  }

  runtime::RunPlan plan_;
  FakeParticipant participant_;
  RemoteEndpoint writer_;
  StartBarrier barrier_;
  Texts notices_, fatal_;
  std::vector<domain::Incident> incidents_;
  std::vector<Progress> progress_;
  std::vector<Checkpoint> checkpoints_;
  std::string spooled_;
  std::unique_ptr<NodeHost> host_;
};

TEST_F(Host, StepsAsSoonAsTheInputsOfATickAreThere) {
  make();

  deliver(0);
  deliver(1);

  ASSERT_EQ(commands().size(), 2u);
  EXPECT_EQ(decoded(commands()[1]).stamp.tick, 1u);
  EXPECT_EQ(decoded(commands()[1]).motion.step_m, 0.01);
}

TEST_F(Host, WaitsForTheTickThatIsMissing) {
  make();

  deliver(1);
  EXPECT_TRUE(commands().empty());
  deliver(0);

  EXPECT_EQ(commands().size(), 2u);
}

TEST_F(Host, WaitsForTheGoIfNobodyElseKnowsWhenAllAreThere) {
  Assignment assignment;
  assignment.waits_for_go = true;
  NodeHost& host = make(assignment);

  deliver(0);
  EXPECT_TRUE(commands().empty());
  host.go(Time{});
  deliver(1);

  EXPECT_EQ(commands().size(), 2u);
}

TEST_F(Host, DropsWhatItKnows) {
  make();

  deliver(0);
  deliver(0);

  EXPECT_EQ(commands().size(), 1u);
  EXPECT_TRUE(fatal_.empty());
}

TEST_F(Host, TurnsAwaySamplesOfStrangers) {
  NodeHost& host = make();
  const RemoteEndpoint stranger = remote(true, "target", "control", data_of("control"));

  participant_.deliver("target", target_of(0), &stranger);
  participant_.deliver("target", target_of(0), nullptr);
  host.flush();

  EXPECT_TRUE(commands().empty());
  EXPECT_EQ(progress_.back().refused_samples, 2u);
}

TEST_F(Host, EndsTheRunInLockstepOverASampleThatIsNone) {
  make();

  participant_.deliver("target", "no CDR", &writer_);

  ASSERT_EQ(fatal_.size(), 1u);
  EXPECT_EQ(fatal_[0].rfind("echo refuses a sample of 'target': ", 0), 0u) << fatal_[0];
  EXPECT_EQ(progress_.back().refused_samples, 1u);
}

TEST_F(Host, OnlyTellsOfItInRealTime) {
  Assignment assignment;
  assignment.pace = Pace::kRealtime;
  make(assignment);

  participant_.deliver("target", "no CDR", &writer_);

  ASSERT_EQ(incidents_.size(), 1u);
  EXPECT_EQ(incidents_[0].kind, domain::kRefused);
  EXPECT_EQ(incidents_[0].text.rfind("echo refuses a sample of 'target': ", 0), 0u);
  EXPECT_TRUE(fatal_.empty());
}

TEST_F(Host, SaysWhatItLostWhenASampleIsTooFarAhead) {
  make();

  deliver(kHistoryDepth);

  EXPECT_EQ(fatal_, Texts{"echo is at tick 0 and lost 'target' of tick 512"});
}

TEST_F(Host, KeepsWhatTheVendorDoesNotTakeAndWritesItLaterInOrder) {
  NodeHost& host = make();
  participant_.answer(WriteStatus::kWouldBlock);
  deliver(0);
  deliver(1);
  EXPECT_FALSE(host.finished(1)) << "a write still waits";

  participant_.answer(WriteStatus::kTaken);
  host.poll(Time{});

  ASSERT_EQ(commands().size(), 2u);
  EXPECT_EQ(decoded(commands()[0]).stamp.tick, 0u);
  EXPECT_TRUE(host.finished(1));
}

TEST_F(Host, EndsTheRunWhenAWriteFails) {
  make();
  participant_.answer(WriteStatus::kFailed);

  deliver(0);
  deliver(1);

  EXPECT_EQ(fatal_, Texts{"echo cannot write 'command'"}) << "and steps no more";
}

TEST_F(Host, IsFinishedWhenItHasSteppedTheLastTick) {
  NodeHost& host = make();
  deliver(0);

  EXPECT_FALSE(host.finished(1));
  deliver(1);

  const auto finished = host.finished(1);
  ASSERT_TRUE(finished);
  EXPECT_EQ(finished->chains.count("command"), 1u);
}

TEST_F(Host, GoesOnFromACheckpointWithTheSameBytesAndHash) {
  Assignment assignment;
  assignment.spooling = Spooling::kSamples;
  make(assignment);
  for (std::uint64_t tick = 0; tick < 100; ++tick) deliver(tick);
  ASSERT_EQ(checkpoints_.size(), 1u);
  EXPECT_EQ(checkpoints_[0].tick, kTicksPerCheckpoint);
  const Texts first = commands();
  const auto chains = host_->finished(99)->chains;

  FakeParticipant again;
  NodeHost second(runtime::NodeSuccession(echo_node()), assignment, plan_,
                  {[](auto) {}, [](auto) {}, [](const auto&) {}, [](const auto&) {}, [](auto) {}});
  ASSERT_TRUE(second.restore(checkpoints_[0]).ok());
  ASSERT_TRUE(second.open(again, barrier_).ok());
  second.repeat_last_outputs(checkpoints_[0]);
  for (std::uint64_t tick = 0; tick < 100; ++tick) {
    again.deliver("target", target_of(tick), &writer_);
  }

  // The last tick before the checkpoint is written again, then all after it.
  const Texts expected(first.begin() + kTicksPerCheckpoint - 1, first.end());
  EXPECT_EQ(again.written("command"), expected);
  EXPECT_EQ(second.finished(99)->chains, chains);
}

TEST_F(Host, RefusesACheckpointThatIsNone) {
  make();

  EXPECT_FALSE(host_->restore({64, "no state", "", {}}).ok());
}

TEST_F(Host, SpoolsWhatItWritesForTheRecording) {
  Assignment assignment;
  assignment.spooling = Spooling::kSamples;
  make(assignment);
  deliver(0);
  deliver(1);
  host_->flush();

  std::vector<std::uint64_t> ticks;
  EXPECT_TRUE(for_each_spooled(
      spooled_, {[&](const auto& sample) { ticks.push_back(sample.tick); }, [](const auto&) {}}));
  EXPECT_EQ(ticks, (std::vector<std::uint64_t>{0, 1}));
}

TEST_F(Host, MayBeAskedFromOtherThreadsWhileSamplesCome) {
  NodeHost& host = make();

  std::thread asking([&] {
    for (int i = 0; i < 1000; ++i) {
      host.poll(Time{});
      host.flush();
      host.is_stepping();
      host.finished(0);
    }
  });
  for (std::uint64_t tick = 0; tick < 1000; ++tick) deliver(tick);
  asking.join();

  EXPECT_EQ(commands().size(), 1000u);
}

}  // namespace
}  // namespace clew::bridge

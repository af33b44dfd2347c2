// SPDX-License-Identifier: Apache-2.0
#include "component/process_host.hpp"

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "fake_participant.hpp"
#include "line/user_data.hpp"
#include "run/limits.hpp"
#include "wire/codec.hpp"

namespace clew::bridge {
namespace {

using domain::Topic;
using Texts = std::vector<std::string>;

runtime::TopicSet only(Topic topic) { return runtime::TopicSet().set(domain::index_of(topic)); }

/// Counts its steps, which are its state.
class Counter : public runtime::Component {
 public:
  void step(const runtime::TickInputs&, runtime::TickOutputs&) override { ++steps_; }
  void save(core::StateWriter& writer) const override { writer(steps_); }
  void load(core::StateReader& reader) override { reader(steps_); }

 private:
  std::uint64_t steps_ = 0;
};

runtime::Node node(const std::string& name, Topic input, Topic output) {
  runtime::NodePorts ports;
  ports.inputs = ports.declared_inputs = only(input);
  ports.outputs = only(output);
  ports.output_order = {output};
  return runtime::Node(name, std::move(ports), std::make_unique<Counter>(), 0.1);
}

template <typename Message>
std::string sample(std::uint64_t tick) {
  Message message;
  message.stamp = {tick, 0.1 * static_cast<double>(tick), tick};
  if constexpr (std::is_same_v<Message, domain::Target>) message.radius_m = 0.2;
  Codec<Message> codec;
  return std::string(codec.encode(message));
}

/// Two stages: `first` makes commands of targets, `second` makes events of odometry.
class TwoStages : public testing::Test {
 protected:
  TwoStages()
      : plan_writer_(remote(true, "target", "plan", data_of("plan"))),
        drive_writer_(remote(true, "odometry", "drive", data_of("drive"))),
        barrier_("both", {{"target", true, "plan", false}, {"odometry", true, "drive", false}},
                 {[] {}, [](const auto&) {}, [](const auto&) {}}) {
    plan_.graph.tick_s = 0.1;
    barrier_.on_matched(plan_writer_);
    barrier_.on_matched(drive_writer_);
  }
  static std::string data_of(const std::string& stage) {
    return UserData{std::string(idl_fingerprint()), stage}.to_text();
  }
  ProcessHost& make() {
    std::vector<runtime::NodeSuccession> nodes;
    nodes.emplace_back(node("first", Topic::kTarget, Topic::kCommand));
    nodes.emplace_back(node("second", Topic::kOdometry, Topic::kEvent));
    host_ = std::make_unique<ProcessHost>(
        std::move(nodes), Assignment{}, plan_,
        NodeHost::Handlers{[](const auto&) {}, [this](std::string text) { fatal_ = text; },
                           [this](const Progress& progress) { progress_ = progress; },
                           [this](const Checkpoint& one) { checkpoints_.push_back(one); },
                           [](const auto&) {}});
    EXPECT_TRUE(host_->open(participant_, barrier_).ok());
    return *host_;
  }
  void feed_first(std::uint64_t from, std::uint64_t to) {
    for (std::uint64_t tick = from; tick < to; ++tick) {
      participant_.deliver("target", sample<domain::Target>(tick), &plan_writer_);
    }
  }
  void feed_second(std::uint64_t from, std::uint64_t to) {
    for (std::uint64_t tick = from; tick < to; ++tick) {
      participant_.deliver("odometry", sample<domain::Odometry>(tick), &drive_writer_);
    }
  }

  RemoteEndpoint plan_writer_;
  RemoteEndpoint drive_writer_;
  StartBarrier barrier_;
  runtime::RunPlan plan_;
  FakeParticipant participant_;
  std::unique_ptr<ProcessHost> host_;
  std::string fatal_;
  Progress progress_;
  std::vector<Checkpoint> checkpoints_;
};

TEST_F(TwoStages, AreAsFarAsTheLastOfThem) {
  ProcessHost& host = make();

  feed_first(0, 5);
  feed_second(0, 3);
  host.flush();

  EXPECT_EQ(progress_.ticks, 3u);
  EXPECT_EQ(progress_.most_ticks, 5u);
  EXPECT_EQ(fatal_, "");
}

TEST_F(TwoStages, AreFinishedWhenBothAre) {
  ProcessHost& host = make();

  feed_first(0, 5);
  feed_second(0, 4);
  EXPECT_FALSE(host.finished(4));
  feed_second(4, 5);

  const auto finished = host.finished(4);
  ASSERT_TRUE(finished);
  EXPECT_EQ(finished->chains.size(), 2u);
}

TEST_F(TwoStages, HaveACheckpointWhereBothHaveOne) {
  make();

  feed_first(0, kTicksPerCheckpoint);
  EXPECT_TRUE(checkpoints_.empty());
  feed_second(0, kTicksPerCheckpoint);

  ASSERT_EQ(checkpoints_.size(), 1u);
  EXPECT_EQ(checkpoints_[0].tick, kTicksPerCheckpoint);
  const auto parts = unpack_checkpoints(checkpoints_[0]);
  ASSERT_TRUE(parts.ok()) << parts.error().text();
  EXPECT_EQ(parts->size(), 2u);
}

TEST_F(TwoStages, GoOnFromACheckpointAsIfTheyHadNeverStopped) {
  make();
  feed_first(0, kTicksPerCheckpoint + 3);
  feed_second(0, kTicksPerCheckpoint + 2);
  const auto whole = host_->finished(kTicksPerCheckpoint + 1);
  ASSERT_EQ(checkpoints_.size(), 1u);
  const Checkpoint kept = checkpoints_[0];

  make();
  ASSERT_TRUE(host_->restore(kept).ok());
  ASSERT_TRUE(host_->repeat_last_outputs(kept).ok());
  feed_first(kTicksPerCheckpoint, kTicksPerCheckpoint + 3);
  feed_second(kTicksPerCheckpoint, kTicksPerCheckpoint + 2);

  const auto resumed = host_->finished(kTicksPerCheckpoint + 1);
  ASSERT_TRUE(whole && resumed);
  EXPECT_TRUE(resumed->chains == whole->chains);
}

TEST_F(TwoStages, RefuseACheckpointThatIsNotOneOfBoth) {
  ProcessHost& host = make();

  EXPECT_EQ(host.restore({64, "bytes", {}, {}}).error().text(),
            "the checkpoint of the group is not one");
  EXPECT_EQ(host.restore(pack_checkpoints(64, {{"first", {}}})).error().text(),
            "the checkpoint of the group has none of second");
}

}  // namespace
}  // namespace clew::bridge

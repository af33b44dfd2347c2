// SPDX-License-Identifier: Apache-2.0
#include "runtime/node_succession.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

namespace clew::runtime {
namespace {

constexpr double kTick_s = 0.1;

/// Writes `weight` times the sum of the speeds that it has seen.
class Weigher : public Component {
 public:
  explicit Weigher(double weight) : weight_(weight) {}
  void step(const TickInputs& inputs, TickOutputs& outputs) override {
    sum_ += inputs.get<domain::Odometry>().speed_mps;
    outputs.get<domain::Guidance>().target_x_m = weight_ * sum_;
  }
  void save(core::StateWriter& writer) const override { writer(sum_); }
  void load(core::StateReader& reader) override { reader(sum_); }

 private:
  double weight_;
  double sum_ = 0.0;
};

Node weigher(double weight) {
  NodePorts ports;
  ports.inputs.set(index_of(Topic::kOdometry));
  ports.declared_inputs = ports.inputs;
  ports.outputs.set(index_of(Topic::kGuidance));
  ports.output_order = {Topic::kGuidance};
  return Node("recover", ports, std::make_unique<Weigher>(weight), kTick_s);
}

Successor successor(std::uint64_t tick, std::uint64_t fed_from, bool keeps_state = false) {
  return {tick, fed_from, tick, keeps_state, [] { return weigher(10.0); }};
}

/// Steps at a speed of 1 m/s; returns what is written, which must carry the tick's numbers.
double step(NodeSuccession& node, std::uint64_t tick) {
  domain::Messages messages;
  std::get<domain::Odometry>(messages).speed_mps = 1.0;
  node.step(tick, node.ports().inputs, messages);
  const auto& guidance = std::get<domain::Guidance>(messages);
  EXPECT_EQ(guidance.stamp.tick, tick);
  EXPECT_EQ(guidance.stamp.sequence, tick);
  return guidance.target_x_m;
}

std::vector<double> steps(NodeSuccession& node, std::uint64_t from, std::uint64_t to) {
  std::vector<double> written;
  for (std::uint64_t tick = from; tick < to; ++tick) written.push_back(step(node, tick));
  return written;
}

TEST(NodeSuccession, ASuccessorTakesOverAtItsTickAndHasSeenWhatItWasFed) {
  NodeSuccession node(weigher(1.0));
  node.add(successor(4, 2));

  // The old one counts from tick 0; the new one has seen ticks 2 and 3 when tick 4 comes.
  EXPECT_EQ(steps(node, 0, 6), (std::vector<double>{1, 2, 3, 4, 30, 40}));
}

TEST(NodeSuccession, OneThatKeepsTheStateGoesOnWithIt) {
  NodeSuccession node(weigher(1.0));
  node.add(successor(3, 3, true));

  EXPECT_EQ(steps(node, 0, 5), (std::vector<double>{1, 2, 3, 40, 50}));
}

TEST(NodeSuccession, GoesOnFromWhatWasSavedWhileASuccessorWasFed) {
  NodeSuccession whole(weigher(1.0));
  whole.add(successor(6, 1));
  steps(whole, 0, 4);
  const auto state = whole.save();
  const auto fed = whole.save_successors();

  NodeSuccession again(weigher(1.0));
  again.add(successor(6, 1));
  again.skip_to(4);
  ASSERT_TRUE(again.load(state).ok());
  ASSERT_TRUE(again.load_successors(fed).ok());

  EXPECT_EQ(steps(again, 4, 8), steps(whole, 4, 8));
}

TEST(NodeSuccession, SkipsThoseWhoseTurnIsOver) {
  NodeSuccession whole(weigher(1.0));
  whole.add(successor(2, 0));
  steps(whole, 0, 5);

  NodeSuccession again(weigher(1.0));
  again.add(successor(2, 0));
  again.skip_to(5);
  ASSERT_TRUE(again.load(whole.save()).ok());

  EXPECT_EQ(step(again, 5), step(whole, 5));
}

TEST(NodeSuccession, AsksForThePastOfASuccessorThatWasAnnouncedLate) {
  NodeSuccession node(weigher(1.0));
  steps(node, 0, 4);
  node.add(successor(5, 1));

  std::vector<std::uint64_t> asked;
  const auto fed = node.feed_past(4, {}, [&](Successor& next) -> core::Result<void> {
    domain::Messages messages;
    std::get<domain::Odometry>(messages).speed_mps = 1.0;
    for (std::uint64_t tick = next.fed_from; tick < 4; ++tick) {
      asked.push_back(tick);
      NodeSuccession::feed(next, tick, node.ports().inputs, messages);
    }
    return {};
  });

  ASSERT_TRUE(fed.ok());
  EXPECT_EQ(asked, (std::vector<std::uint64_t>{1, 2, 3}));
  // Ticks 1 to 4, and tick 5 itself.
  EXPECT_EQ(steps(node, 4, 6), (std::vector<double>{5, 50}));
}

}  // namespace
}  // namespace clew::runtime

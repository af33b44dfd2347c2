// SPDX-License-Identifier: Apache-2.0
/// States come from recordings, and recordings from strangers. Whatever stands in a state of
/// whatever behaviour, loading it is refused or the behaviour steps on as with any other. Built
/// with the sanitizers (preset asan) the test also finds what only happens to do no harm.
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "../replay/every_behaviour.hpp"
#include "../replay/recorded_run.hpp"
#include "runtime/composed_executor.hpp"

namespace clew::replay_test {
namespace {

using runtime::TopicSet;

constexpr std::uint64_t kPast = 100;  // ticks before the state that is tampered with
constexpr std::uint64_t kMore = 3;    // that a component steps with it

bool soak() { return std::getenv("CLEW_SOAK") != nullptr; }
std::size_t mutants() { return soak() ? 20000 : 120; }

/// What a field may become: as a number, an index, an enumerator, a length.
std::vector<std::string> nasty_values() {
  std::vector<std::string> values;
  const auto add = [&](const auto& value) {
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    values.push_back(bytes);
  };
  for (const double number : {std::numeric_limits<double>::quiet_NaN(), 1e300, -1e300,
                              std::numeric_limits<double>::infinity(), 5e-324}) {
    add(number);
  }
  for (const std::uint64_t number : {~std::uint64_t{0}, std::uint64_t{1} << 63, std::uint64_t{9}}) {
    add(number);
  }
  for (const std::uint32_t number :
       {~std::uint32_t{0}, std::uint32_t{1} << 31, std::uint32_t{77}}) {
    add(number);
  }
  for (const std::uint8_t number :
       {std::uint8_t{2}, std::uint8_t{9}, std::uint8_t{128}, std::uint8_t{255}}) {
    add(number);
  }
  return values;
}

/// A component in the middle of a run, and what it is fed next.
struct Scene {
  runtime::Node node;
  std::string state;
  std::vector<domain::Messages> inputs;
};

Scene scene_of(const Behaviour& behaviour) {
  const auto plan = plan_with(behaviour, kPast + kMore + 1);
  CLEW_CHECK(plan.has_value(), behaviour.name + " fits no shipped graph");
  runtime::ComposedExecutor executor(runtime::make_nodes(*plan).value(), nullptr);
  while (executor.next_tick() < kPast) executor.step();
  auto node = runtime::make_node(*plan, *plan->graph.find(behaviour.stage)).value();
  std::string state;
  for (const auto& candidate : executor.nodes()) {
    if (candidate.name() == behaviour.stage) state = candidate.save();
  }
  std::vector<domain::Messages> inputs;
  for (std::uint64_t tick = 0; tick < kMore; ++tick) {
    executor.step();
    inputs.push_back(executor.messages());
  }
  return {std::move(node), std::move(state), std::move(inputs)};
}

void step(Scene& scene) {
  const TopicSet present = scene.node.ports().all_inputs();
  for (std::uint64_t tick = 0; tick < kMore; ++tick) {
    domain::Messages messages = scene.inputs[tick];
    scene.node.step(kPast + tick, present, messages);
  }
}

std::string tampered(const std::string& state, std::size_t place, const std::string& value) {
  std::string mutant = state;
  mutant.replace(place, std::min(value.size(), state.size() - place), value, 0,
                 std::min(value.size(), state.size() - place));
  return mutant;
}

class HostileState : public testing::TestWithParam<Behaviour> {};

TEST_P(HostileState, IsRefusedOrHarmless) {
  Scene scene = scene_of(GetParam());
  ASSERT_TRUE(scene.node.load(scene.state).ok());
  const auto values = nasty_values();
  std::mt19937 numbers(20261128);
  std::size_t refused = 0;

  for (std::size_t i = 0; i < mutants(); ++i) {
    // The front of a state, where its own numbers stand, more often than the middle of a map.
    const std::size_t reach =
        i % 2 == 0 ? std::min<std::size_t>(scene.state.size(), 256) : scene.state.size();
    const auto mutant = tampered(scene.state, numbers() % reach, values[i % values.size()]);
    if (scene.node.load(mutant).ok()) {
      step(scene);
    } else {
      ++refused;
    }
  }
  // Cut anywhere, it is short.
  for (std::size_t size = 0; size < scene.state.size(); size += 1 + scene.state.size() / 40) {
    EXPECT_FALSE(scene.node.load(scene.state.substr(0, size)).ok()) << size;
  }

  EXPECT_TRUE(scene.node.load(scene.state).ok());
  step(scene);
  RecordProperty("refused", static_cast<int>(refused));
}

INSTANTIATE_TEST_SUITE_P(OfEveryBehaviour, HostileState, testing::ValuesIn(all_behaviours()),
                         [](const auto& tested) {
                           return tested.param.stage + '_' + tested.param.part + '_' +
                                  tested.param.name;
                         });

TEST(HostileState, OfANumberThatIsNoneTheFaultAndThePlaceAreTold) {
  Scene scene = scene_of({"drive", "behaviour", "turn_then_step"});
  // Behind the counts of the outputs stands the pose: x first.
  const std::size_t pose = domain::kTopicCount * sizeof(std::uint64_t);
  const auto mutant = tampered(scene.state, pose, nasty_values().front());

  const auto loaded = scene.node.load(mutant);

  ASSERT_FALSE(loaded.ok());
  EXPECT_EQ(loaded.error().message,
            "the saved state of drive is not one of this component: a number is NaN, byte " +
                std::to_string(pose) + " of " + std::to_string(scene.state.size()));
}

}  // namespace
}  // namespace clew::replay_test

// SPDX-License-Identifier: Apache-2.0
/// Saved states, as recordings hold them: whatever stands in one, it is refused, or its component
/// steps on. tests/hostile does the same for every behaviour, by field.
#include <vector>

#include "runtime/composed_executor.hpp"
#include "runtime/run_plan.hpp"
#include "stages/all.hpp"
#include "target.hpp"
#include "tests/source_path.hpp"

namespace clew::fuzz {
namespace {

constexpr std::uint64_t kPast = 40;  // ticks before the state
constexpr std::uint64_t kMore = 3;   // that a component steps with it

/// A component in the middle of a run, and what it is fed next.
struct Scene {
  runtime::Node node;
  std::string state;
  std::vector<domain::Messages> inputs;
};

void add_scenes(const std::string& graph, std::vector<Scene>& scenes) {
  const runtime::ConfigPath configs({tests::source_path("configs")});
  runtime::GraphOverrides overrides;
  overrides.max_ticks = kPast + kMore + 1;
  const auto plan = runtime::prepare_run(graph, overrides, configs, stages::all());
  CLEW_CHECK(plan.ok(), graph + " is refused");
  runtime::ComposedExecutor executor(runtime::make_nodes(*plan).value(), nullptr);
  while (executor.next_tick() < kPast) executor.step();
  const std::size_t first = scenes.size();
  for (const auto& node : executor.nodes()) {
    scenes.push_back(
        {runtime::make_node(*plan, *plan->graph.find(node.name())).value(), node.save(), {}});
  }
  for (std::uint64_t tick = 0; tick < kMore; ++tick) {
    executor.step();
    for (std::size_t i = first; i < scenes.size(); ++i) {
      scenes[i].inputs.push_back(executor.messages());
    }
  }
}

std::vector<Scene>& all_scenes() {
  static std::vector<Scene> scenes = [] {
    std::vector<Scene> all;
    for (const char* graph : {"krishna_kalra", "lagoudakis_maida", "nakhaeinia", "neural_map",
                              "pin_bender", "wang_yang_meng", "give_way"}) {
      add_scenes(graph, all);
    }
    return all;
  }();
  return scenes;
}

/// Behind one byte that chooses the component.
void read_state(std::string_view input) {
  if (input.empty()) return;
  auto& scenes = all_scenes();
  Scene& scene = scenes[static_cast<unsigned char>(input[0]) % scenes.size()];
  if (!is_good(scene.node.load(std::string(input.substr(1))))) return;
  for (std::uint64_t tick = 0; tick < kMore; ++tick) {
    domain::Messages messages = scene.inputs[tick];
    scene.node.step(kPast + tick, scene.node.ports().all_inputs(), messages);
  }
}

Seeds states() {
  Seeds seeds;
  for (const Scene& scene : all_scenes()) {
    seeds.push_back(std::string(1, static_cast<char>(seeds.size())) + scene.state);
  }
  return seeds;
}

}  // namespace

std::vector<Target> state_targets() { return {{"state", read_state, states}}; }

}  // namespace clew::fuzz

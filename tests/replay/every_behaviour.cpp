// SPDX-License-Identifier: Apache-2.0
#include "every_behaviour.hpp"

#include <utility>

#include "recorded_run.hpp"
#include "stages/all.hpp"

namespace clew::replay_test {

std::vector<Behaviour> all_behaviours() {
  std::vector<Behaviour> all;
  for (const runtime::StageInfo& stage : stages::all()) {
    for (const runtime::PartInfo& part : stage.parts) {
      for (const runtime::VariantInfo& variant : part.variants) {
        all.push_back({stage.name, part.name, variant.name});
      }
    }
  }
  return all;
}

std::optional<runtime::RunPlan> plan_with(const Behaviour& behaviour, std::uint64_t max_ticks,
                                          const std::string& world, const std::string& graph) {
  auto overrides =
      changes({behaviour.stage + '.' + behaviour.part + '=' + behaviour.name}, {}, max_ticks);
  if (!world.empty()) overrides.world = world;
  // In reverse, since the last ones are the papers' and the first two keep maps, which takes
  // longer.
  auto graphs = shipped_configs().names("graphs");
  if (!graph.empty()) graphs.push_back(graph);
  for (auto name = graphs.rbegin(); name != graphs.rend(); ++name) {
    auto plan = runtime::prepare_run(*name, overrides, shipped_configs(), stages::all());
    if (plan.ok()) return std::move(plan).value();
  }
  return std::nullopt;
}

}  // namespace clew::replay_test

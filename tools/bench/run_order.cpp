// SPDX-License-Identifier: Apache-2.0
#include "bench/run_order.hpp"

namespace clew::bench {

RunOrder::RunOrder(const BenchPlan& plan) : plan_(plan) {
  for (std::size_t i = 0; i < plan.variants.size(); ++i) {
    variants_[{plan.variants[i].graph, plan.variants[i].text()}] = i;
  }
  for (std::size_t i = 0; i < plan.worlds.size(); ++i) worlds_[plan.worlds[i].name] = i;
  for (std::size_t i = 0; i < plan.seeds.size(); ++i) seeds_[plan.seeds[i]] = i;
}

std::optional<std::size_t> RunOrder::index_of(const RunKey& key) const {
  const auto variant = variants_.find({key.graph, key.variant});
  const auto world = worlds_.find(key.world);
  const auto seed = seeds_.find(key.seed);
  if (variant == variants_.end() || world == worlds_.end() || seed == seeds_.end()) {
    return std::nullopt;
  }
  return index_of(variant->second, world->second, seed->second);
}

RunKey RunOrder::key_of(std::size_t index) const {
  const std::size_t seeds = plan_.seeds.size();
  const std::size_t worlds = plan_.worlds.size();
  const Variant& variant = plan_.variants[index / seeds / worlds];
  return {variant.graph, variant.text(), plan_.worlds[index / seeds % worlds].name,
          plan_.seeds[index % seeds]};
}

std::pair<std::size_t, std::size_t> RunOrder::in_world(std::size_t index) const {
  const std::size_t seeds = plan_.seeds.size();
  const std::size_t worlds = plan_.worlds.size();
  return {index / seeds % worlds, index / seeds / worlds * seeds + index % seeds};
}

std::string run_text(const RunKey& key) {
  return key.graph + (key.variant.empty() ? "" : " [" + key.variant + ']') + " in " + key.world +
         ", seed " + std::to_string(key.seed);
}

}  // namespace clew::bench

// SPDX-License-Identifier: Apache-2.0
#include "bench/stopping.hpp"

#include <algorithm>
#include <map>

namespace clew::bench {

Batches::Batches(const BenchPlan& plan) : plan_(plan), count_(plan.seeds.size()) {
  if (count_ > 1) return;
  std::map<std::string, std::size_t> worlds_of_family;
  for (const BenchWorld& world : plan.worlds) {
    batch_of_world_.push_back(worlds_of_family[world.family]++);
    count_ = std::max(count_, batch_of_world_.back() + 1);
  }
}

BenchPlan Batches::first(std::size_t number) const {
  BenchPlan part = plan_;
  if (batch_of_world_.empty()) {
    part.seeds.resize(number);
    return part;
  }
  part.worlds.clear();
  for (std::size_t i = 0; i < plan_.worlds.size(); ++i) {
    if (batch_of_world_[i] < number) part.worlds.push_back(plan_.worlds[i]);
  }
  return part;
}

SequentialShare sequential_share(const BenchResults& results, std::size_t variant) {
  SequentialShare share;
  for (const RunResult* run : results.samples_of(variant)) {
    if (!run->success) continue;
    ++share.trials;
    share.successes += *run->success ? 1 : 0;
  }
  share.interval = anytime_interval(share.successes, share.trials);
  return share;
}

double widest(const BenchResults& results) {
  double width = 0.0;
  for (std::size_t i = 0; i < results.plan->variants.size(); ++i) {
    width = std::max(width, sequential_share(results, i).width());
  }
  return width;
}

}  // namespace clew::bench

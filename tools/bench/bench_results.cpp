// SPDX-License-Identifier: Apache-2.0
#include "bench/bench_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <unordered_set>

#include "bench/stopping.hpp"

namespace clew::bench {
namespace {

std::string copies_text(const BenchResults& results) {
  std::size_t copies = results.runs.size();
  for (std::size_t i = 0; i < results.plan->variants.size(); ++i) {
    copies -= results.samples_of(i).size();
  }
  if (copies == 0) return {};
  return fmt::format(
      "{} of {} runs equal another one of the same graph in the same world to the byte (they have "
      "one hash): they are one sample, and counted once.",
      copies, results.runs.size());
}

std::string seeds_text(const BenchResults& results) {
  const auto& variants = results.plan->variants;
  std::string untouched;
  std::size_t count = 0;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    if (!results.ignores_seeds(i)) continue;
    untouched += (count++ == 0 ? "" : ", ") + variants[i].label();
  }
  if (count == 0) return {};
  return fmt::format(
      "Seeds make no difference to {}: no noise is on ('clew list sense' and 'clew list drive' "
      "tell "
      "what there is).",
      count == variants.size() ? "any graph here" : untouched);
}

std::string unknown_text(const BenchResults& results) {
  std::vector<std::string> worlds;
  for (const RunResult& run : results.runs) {
    if (run.solvable) continue;
    if (std::find(worlds.begin(), worlds.end(), run.key.world) == worlds.end()) {
      worlds.push_back(run.key.world);
    }
  }
  if (worlds.empty()) return {};
  return fmt::format(
      "{} of {} worlds do not say whether they can be solved ({}): they stand apart, and "
      "'unreachable' there is neither a success nor a failure.",
      worlds.size(), results.plan->worlds.size(), fmt::join(worlds, ", "));
}

std::string stopping_text(const BenchResults& results) {
  const auto& stopping = results.plan->stopping;
  if (!stopping) return {};
  const double width = widest(results);
  return fmt::format(
      "{} after {} of {} batches: the widest interval of a graph's success is {:.4f}, {:.4f} was "
      "asked for.",
      width <= stopping->width ? "Ended" : "Not known well enough", stopping->batches, stopping->of,
      width, stopping->width);
}

}  // namespace

std::vector<const RunResult*> BenchResults::of_variant(std::size_t variant) const {
  std::vector<const RunResult*> chosen;
  const std::size_t each = plan->worlds.size() * plan->seeds.size();
  for (std::size_t i = variant * each; i < (variant + 1) * each; ++i) chosen.push_back(&runs[i]);
  return chosen;
}

std::vector<const RunResult*> BenchResults::samples_of(std::size_t variant) const {
  std::vector<const RunResult*> samples;
  std::unordered_set<std::string_view> hashes;  // of the present world
  const RunResult* last = nullptr;
  for (const RunResult* run : of_variant(variant)) {
    if (last != nullptr && last->key.world != run->key.world) hashes.clear();
    last = run;
    if (run->hash.empty() || hashes.insert(run->hash).second) samples.push_back(run);
  }
  return samples;
}

bool BenchResults::ignores_seeds(std::size_t variant) const {
  return plan->seeds.size() > 1 && samples_of(variant).size() == plan->worlds.size();
}

std::vector<std::string> remarks_on(const BenchResults& results) {
  std::vector<std::string> remarks;
  for (std::string text :
       {copies_text(results), seeds_text(results), unknown_text(results), stopping_text(results)}) {
    if (!text.empty()) remarks.push_back(std::move(text));
  }
  return remarks;
}

}  // namespace clew::bench

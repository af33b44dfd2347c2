// SPDX-License-Identifier: Apache-2.0
#include "bench/bench_results.hpp"

#include <fmt/format.h>

#include <algorithm>

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

}  // namespace

std::vector<const RunResult*> BenchResults::of_variant(std::size_t variant) const {
  std::vector<const RunResult*> chosen;
  const std::size_t each = plan->worlds.size() * plan->seeds.size();
  for (std::size_t i = variant * each; i < (variant + 1) * each; ++i) chosen.push_back(&runs[i]);
  return chosen;
}

std::vector<const RunResult*> BenchResults::samples_of(std::size_t variant) const {
  std::vector<const RunResult*> samples;
  std::size_t of_world = 0;  // where those of the present world begin
  for (const RunResult* run : of_variant(variant)) {
    if (!samples.empty() && samples.back()->key.world != run->key.world) of_world = samples.size();
    const auto first = samples.begin() + static_cast<std::ptrdiff_t>(of_world);
    const bool known = std::any_of(first, samples.end(),
                                   [&](const RunResult* other) { return is_copy(*run, *other); });
    if (!known) samples.push_back(run);
  }
  return samples;
}

bool BenchResults::ignores_seeds(std::size_t variant) const {
  return plan->seeds.size() > 1 && samples_of(variant).size() == plan->worlds.size();
}

bool is_copy(const RunResult& run, const RunResult& of) {
  return !run.hash.empty() && run.hash == of.hash && run.key.world == of.key.world;
}

std::vector<std::string> remarks_on(const BenchResults& results) {
  std::vector<std::string> remarks;
  for (std::string text : {copies_text(results), seeds_text(results), unknown_text(results)}) {
    if (!text.empty()) remarks.push_back(std::move(text));
  }
  return remarks;
}

}  // namespace clew::bench

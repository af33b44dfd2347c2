// SPDX-License-Identifier: Apache-2.0
#include "bench/pairs.hpp"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bench/statistics.hpp"

namespace clew::bench {
namespace {

/// The variant that another is compared with: itself if it is what others are compared with.
std::size_t first_of_last_variation(const std::vector<Variant>& variants, std::size_t which) {
  if (variants[which].values.empty()) return 0;
  // The last variation changes fastest, so the first of its values is the first with all else.
  const auto all_but_last = [](const Variant& variant) {
    auto values = variant.values;
    values.pop_back();
    return values;
  };
  std::size_t other = 0;
  while (variants[other].graph != variants[which].graph ||
         all_but_last(variants[other]) != all_but_last(variants[which])) {
    ++other;
  }
  return other;
}

/// The variant of the first graph with the same values.
std::size_t same_of_first_graph(const std::vector<Variant>& variants, std::size_t which) {
  std::size_t other = 0;
  while (variants[other].values != variants[which].values) ++other;
  return other;
}

/// Two variants in the same worlds with the same seeds.
struct PairTotal {
  std::size_t only_this = 0;        ///< succeeds
  std::size_t only_other = 0;       ///< succeeds
  std::vector<double> path_ratios;  ///< where both reached the target
  std::vector<double> time_ratios;  ///< the same, of simulated time
};

PairTotal pair_total(const std::vector<const RunResult*>& runs,
                     const std::vector<const RunResult*>& others) {
  PairTotal total;
  // A pair of runs that are both copies of those of another seed is that pair.
  std::set<std::array<std::string, 3>> seen;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const RunResult& run = *runs[k];
    const RunResult& other = *others[k];
    const bool hashed = !run.hash.empty() && !other.hash.empty();
    if (hashed && !seen.insert({run.key.world, run.hash, other.hash}).second) continue;
    if (run.success && other.success) {
      total.only_this += *run.success && !*other.success ? 1 : 0;
      total.only_other += *other.success && !*run.success ? 1 : 0;
    }
    if (!run.reached() || !other.reached()) continue;
    if (other.path_length_m > 0.0) {
      total.path_ratios.push_back(run.path_length_m / other.path_length_m);
    }
    if (other.sim_time_s > 0.0) total.time_ratios.push_back(run.sim_time_s / other.sim_time_s);
  }
  return total;
}

std::string with_interval(double value, const std::optional<Interval>& interval) {
  std::string text = fmt::format("{:.3f}", value);
  if (interval) text += fmt::format(" [{:.3f}, {:.3f}]", interval->low, interval->high);
  return text;
}

/// Appends median with the number of ratios, mean, and 90 % quantile.
void append_ratios(const std::vector<double>& ratios, std::vector<std::string>& row) {
  if (ratios.empty()) {
    row.insert(row.end(), 3, "");
    return;
  }
  row.push_back(with_interval(quantile(ratios, 0.5), quantile_interval(ratios, 0.5)) +
                fmt::format(" of {}", ratios.size()));
  row.push_back(with_interval(mean(ratios), mean_interval(ratios)));
  row.push_back(with_interval(quantile(ratios, 0.9), quantile_interval(ratios, 0.9)));
}

template <typename Counterpart>
Table compare(const BenchResults& results, std::string title, Counterpart counterpart) {
  const auto& variants = results.plan->variants;
  Table table;
  table.title = std::move(title);
  table.note =
      "In the same worlds with the same seeds. p: McNemar's test, exact, two-sided. Path: over "
      "that of the other, where both reached the target: median, mean and 90 % quantile, with 95 % "
      "intervals (order statistics; of the mean, the percentiles of 1000 resamples). Time is "
      "simulated, the same way.";
  table.columns = {"graph",
                   "compared with",
                   "only this succeeds",
                   "only the other succeeds",
                   "p",
                   "path over path",
                   "mean",
                   "90 %",
                   "time over time",
                   "mean",
                   "90 %"};
  for (std::size_t i = 1; i < variants.size(); ++i) {
    const std::size_t other = counterpart(variants, i);
    if (other == i) continue;
    const PairTotal total = pair_total(results.of_variant(i), results.of_variant(other));
    std::vector<std::string> row = {
        variants[i].label(), variants[other].label(), std::to_string(total.only_this),
        std::to_string(total.only_other),
        fmt::format("{:.3g}", mcnemar_p(total.only_this, total.only_other))};
    append_ratios(total.path_ratios, row);
    append_ratios(total.time_ratios, row);
    table.rows.push_back(std::move(row));
    table.runs.push_back({{i, {}, {}}, {other, {}, {}}});
  }
  return table;
}

}  // namespace

Table paired_table(const BenchResults& results) {
  if (results.plan->variants.size() < 2) return {};
  return compare(results, "Compared in pairs", first_of_last_variation);
}

Table paired_graphs_table(const BenchResults& results) {
  const auto& variants = results.plan->variants;
  if (variants.empty() || variants.front().values.empty() ||
      variants.front().graph == variants.back().graph) {
    return {};
  }
  return compare(results, "Graphs compared in pairs", same_of_first_graph);
}

}  // namespace clew::bench

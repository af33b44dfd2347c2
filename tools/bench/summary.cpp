// SPDX-License-Identifier: Apache-2.0
#include "bench/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "bench/statistics.hpp"
#include "bench/stopping.hpp"

namespace clew::bench {
namespace {

using Runs = std::vector<const RunResult*>;

template <typename Condition>
std::size_t count(const Runs& runs, const Condition& condition) {
  return static_cast<std::size_t>(std::count_if(
      runs.begin(), runs.end(), [&](const RunResult* run) { return condition(*run); }));
}

template <typename Value>
std::uint64_t sum(const Runs& runs, const Value& value) {
  std::uint64_t total = 0;
  for (const RunResult* run : runs) total += value(*run);
  return total;
}

template <typename Condition>
Runs those(const Runs& runs, const Condition& condition) {
  Runs chosen;
  for (const RunResult* run : runs) {
    if (condition(*run)) chosen.push_back(run);
  }
  return chosen;
}

/// Of those of which it is known.
std::string successes(const Runs& runs) {
  const std::size_t known = count(runs, [](auto& run) { return run.success.has_value(); });
  if (known == 0) return "";
  return share_text(count(runs, [](auto& run) { return run.succeeded(); }), known);
}

Runs with(const Runs& runs, std::optional<bool> solvable) {
  return those(runs, [&](const RunResult& run) { return run.solvable == solvable; });
}

/// Where nobody knows whether there is a way, only that it was found tells something.
std::string reached_of(const Runs& runs) {
  if (runs.empty()) return "";
  return share_text(count(runs, [](auto& run) { return run.reached(); }), runs.size());
}

std::vector<double> path_ratios(const Runs& runs) {
  std::vector<double> ratios;
  for (const RunResult* run : runs) {
    if (const auto ratio = run->path_ratio()) ratios.push_back(*ratio);
  }
  return ratios;
}

/// What all detectors of one name did in a variant's runs.
struct DetectorTotal {
  std::size_t alarms = 0;
  std::size_t false_alarms = 0;
  std::size_t noticed = 0;
  std::size_t captures = 0;
  std::size_t missed = 0;  ///< runs that ended in a trap without an alarm
  std::vector<double> delays_s;
  std::vector<double> delays_m;
};

using DetectorTotals = std::map<std::pair<bool, std::string>, DetectorTotal>;

DetectorTotals detector_totals(const Runs& runs) {
  DetectorTotals totals;
  for (const RunResult* run : runs) {
    if (!run->captures) continue;
    for (const RunResult::Detector& detector : run->detectors) {
      DetectorTotal& total = totals[{detector.shadow, detector.rule}];
      total.alarms += detector.alarms;
      total.false_alarms += detector.false_alarms;
      total.noticed += detector.noticed;
      total.captures += *run->captures;
      total.missed += run->held_at_end && detector.noticed < *run->captures ? 1 : 0;
      const auto append = [](std::vector<double>& all, const std::vector<double>& more) {
        all.insert(all.end(), more.begin(), more.end());
      };
      append(total.delays_s, detector.delays_s);
      append(total.delays_m, detector.delays_m);
    }
  }
  return totals;
}

Table matrix_of(const std::string& graph, const BenchResults& results) {
  const BenchPlan& plan = *results.plan;
  Table table;
  std::map<std::string, std::size_t> row_of;
  std::map<std::string, std::size_t> column_of;
  for (std::size_t i = 0; i < plan.variants.size(); ++i) {
    const Variant& variant = plan.variants[i];
    if (variant.graph != graph) continue;
    if (table.columns.empty()) {
      table.title = graph + ": " + variant.values[0].first + " x " + variant.values[1].first;
      table.columns = {""};
    }
    const auto [row, new_row] = row_of.emplace(variant.values[0].second, table.rows.size());
    if (new_row) table.rows.push_back({variant.values[0].second});
    const auto [column, new_column] =
        column_of.emplace(variant.values[1].second, table.columns.size());
    if (new_column) table.columns.push_back(variant.values[1].second);
    table.rows[row->second].resize(std::max(table.rows[row->second].size(), column->second + 1));
    table.rows[row->second][column->second] = successes(with(results.samples_of(i), true));
    table.runs.resize(table.rows.size());
    table.runs[row->second].resize(table.rows[row->second].size());
    table.runs[row->second][column->second] = {i, {}, std::optional<bool>(true)};
  }
  table.note = "Solvable worlds in which the target was reached, with 95 % intervals (Wilson).";
  return table;
}

}  // namespace

std::string share_text(std::size_t successes, std::size_t trials) {
  const Interval interval = wilson_interval(successes, trials);
  const double share =
      trials == 0 ? 0.0 : static_cast<double>(successes) / static_cast<double>(trials);
  return fmt::format("{}/{} {:.0f} % [{:.0f}, {:.0f}]", successes, trials, 100.0 * share,
                     100.0 * interval.low, 100.0 * interval.high);
}

std::string quantiles_text(const std::vector<double>& values, const char* format) {
  if (values.empty()) return "";
  const auto text = [&](double share) {
    return fmt::format(fmt::runtime(format), quantile(values, share));
  };
  return text(0.5) + ", " + text(0.9);
}

Table overall_table(const BenchResults& results) {
  Table table;
  table.title = "All worlds";
  table.note =
      "Success: the target reached, or called unreachable where it is. Unknown: worlds that do not "
      "say whether they can be solved. Shares with 95 % intervals (Wilson). Path: over the "
      "shortest path, of runs that reached the target, median and 90 % "
      "quantile. Time is simulated, of successful runs.";
  table.columns = {
      "graph",      "success",       "solvable: reached", "unsolvable: told", "unknown: reached",
      "collisions", "hit by moving", "safety stops",      "path / shortest",  "time s"};
  for (std::size_t i = 0; i < results.plan->variants.size(); ++i) {
    const Runs runs = results.samples_of(i);
    std::vector<double> times_s;
    for (const RunResult* run : runs) {
      if (run->succeeded()) times_s.push_back(run->sim_time_s);
    }
    table.rows.push_back(
        {results.plan->variants[i].label(), successes(runs), successes(with(runs, true)),
         successes(with(runs, false)), reached_of(with(runs, std::nullopt)),
         std::to_string(sum(runs, [](auto& run) { return run.collisions; })),
         std::to_string(sum(runs, [](auto& run) { return run.hit_by; })),
         std::to_string(sum(runs, [](auto& run) { return run.safety_stops; })),
         quantiles_text(path_ratios(runs), "{:.2f}"), quantiles_text(times_s, "{:.0f}")});
    using Only = CellRuns::Only;
    const CellRuns all{i, {}, {}};
    table.runs.push_back({all,
                          all,
                          {i, {}, std::optional<bool>(true)},
                          {i, {}, std::optional<bool>(false)},
                          {i, {}, std::optional<bool>()},
                          {i, {}, {}, Only::kCollided},
                          {i, {}, {}, Only::kHit},
                          {i, {}, {}, Only::kStopped},
                          all,
                          all});
  }
  return table;
}

Table family_table(const BenchResults& results) {
  Table table;
  table.title = "Success by family";
  table.columns = {"family"};
  // A family whose worlds partly do not say whether they can be solved has two rows.
  std::vector<std::pair<std::string, bool>> rows;
  for (const BenchWorld& world : results.plan->worlds) {
    for (const bool known : {true, false}) {
      const auto is_of_row = [&](const RunResult& run) {
        return run.family == world.family && run.solvable.has_value() == known;
      };
      if (!std::any_of(results.runs.begin(), results.runs.end(), is_of_row)) continue;
      const std::pair<std::string, bool> row(world.family, known);
      if (std::find(rows.begin(), rows.end(), row) != rows.end()) continue;
      rows.push_back(row);
      table.rows.push_back({world.family + (known ? "" : " (solvable: unknown)")});
      table.runs.push_back({{std::nullopt, world.family, {}}});
    }
  }
  for (std::size_t i = 0; i < results.plan->variants.size(); ++i) {
    table.columns.push_back(results.plan->variants[i].label());
    const Runs runs = results.samples_of(i);
    for (std::size_t row = 0; row < rows.size(); ++row) {
      table.rows[row].push_back(successes(those(runs, [&](auto& run) {
        return run.family == rows[row].first && run.solvable.has_value() == rows[row].second;
      })));
      table.runs[row].push_back({i, rows[row].first, {}});
    }
  }
  return table;
}

Table sequential_table(const BenchResults& results) {
  Table table;
  table.title = "Success, looked at while it came in";
  table.note =
      "Intervals at 95 % that hold however often one looks and whenever one stops (Robbins's "
      "confidence sequence, uniform mixture). Wilson's, in the other tables, are for a number of "
      "runs that is fixed beforehand: here they are too narrow.";
  table.columns = {"graph", "success", "width"};
  for (std::size_t i = 0; i < results.plan->variants.size(); ++i) {
    const SequentialShare share = sequential_share(results, i);
    const double of_all = share.trials == 0 ? 0.0
                                            : static_cast<double>(share.successes) /
                                                  static_cast<double>(share.trials);
    table.rows.push_back(
        {results.plan->variants[i].label(),
         fmt::format("{}/{} {:.2f} % [{:.2f}, {:.2f}]", share.successes, share.trials,
                     100.0 * of_all, 100.0 * share.interval.low, 100.0 * share.interval.high),
         fmt::format("{:.4f}", share.width())});
    table.runs.push_back({{i, {}, {}}, {i, {}, {}}});
  }
  return table;
}

Table detector_table(const BenchResults& results) {
  Table table;
  table.title = "Detectors";
  table.note =
      "A trap captures the robot from entering its region until the robot is nearer to the target "
      "than the trap's minimum. Noticed: captures with an alarm; not every capture is a loop, many "
      "the controller leaves by itself. Missed: runs that ended captured and without an alarm in "
      "some capture. False: alarms neither captured nor in a circle (the robot's body where it "
      "stood more "
      "than 1 m of travel before). Delay: from the capture to its first "
      "alarm, median and 90 % quantile.";
  table.columns = {"graph",  "detector",     "captures", "noticed",
                   "missed", "false alarms", "delay s",  "delay m"};
  for (std::size_t i = 0; i < results.plan->variants.size(); ++i) {
    for (const auto& [name, total] : detector_totals(results.samples_of(i))) {
      table.rows.push_back(
          {results.plan->variants[i].label(), name.second + (name.first ? " (shadow)" : ""),
           std::to_string(total.captures), std::to_string(total.noticed),
           std::to_string(total.missed), std::to_string(total.false_alarms),
           quantiles_text(total.delays_s, "{:.1f}"), quantiles_text(total.delays_m, "{:.1f}")});
      table.runs.push_back({{i, {}, {}}});
    }
  }
  return table;
}

std::vector<Table> matrix_tables(const BenchResults& results) {
  const auto& variants = results.plan->variants;
  if (variants.empty() || variants.front().values.size() != 2) return {};
  std::vector<Table> tables;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    if (i == 0 || variants[i].graph != variants[i - 1].graph) {
      tables.push_back(matrix_of(variants[i].graph, results));
    }
  }
  return tables;
}

}  // namespace clew::bench

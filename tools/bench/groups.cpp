// SPDX-License-Identifier: Apache-2.0
#include "bench/groups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "bench/statistics.hpp"

namespace clew::bench {
namespace {

using nlohmann::ordered_json;

constexpr char kUnknown[] = "unknown";
constexpr char kBugNote[] =
    "Bug1, Bug2: the longest paths that these algorithms take in a world (Lumelsky & Stepanov "
    "1987), over the shortest path, for the robot's centre; above: runs that arrived by a longer "
    "one.";

/// Upper ends of what lengths in sensing ranges are told apart by.
constexpr std::array<double, 5> kEnds_ranges = {0.5, 1.0, 2.0, 4.0, 8.0};
constexpr std::uint32_t kManyPockets = 4;

/// A group's place in the order, and its name.
using Place = std::pair<std::size_t, std::string>;

Place place_of_length(const std::optional<double>& ranges, const char* without) {
  constexpr std::size_t kLast = kEnds_ranges.size() + 1;
  if (!ranges) return {kLast + 1, without};
  if (*ranges == 0.0) return {0, "0"};
  const auto end = std::upper_bound(kEnds_ranges.begin(), kEnds_ranges.end(), *ranges);
  const auto bin = static_cast<std::size_t>(end - kEnds_ranges.begin());
  if (end == kEnds_ranges.begin()) return {1, fmt::format("below {}", kEnds_ranges.front())};
  if (end == kEnds_ranges.end()) return {kLast, fmt::format("{} and more", kEnds_ranges.back())};
  return {bin + 1, fmt::format("{} to {}", kEnds_ranges[bin - 1], kEnds_ranges[bin])};
}

Place place_of_pockets(std::uint32_t pockets) {
  if (pockets < kManyPockets) return {pockets, std::to_string(pockets)};
  return {kManyPockets, fmt::format("{} and more", kManyPockets)};
}

Place place_of(const RunResult& run, Grouping grouping) {
  constexpr std::size_t kAfterAll = SIZE_MAX;
  if (!run.severity) return {kAfterAll, kUnknown};
  switch (grouping) {
    case Grouping::kSeverity:
      return place_of_length(run.severity->deepest_ranges, "no way out");
    case Grouping::kBacktrack:
      return place_of_length(run.severity->backtrack_ranges, "no way");
    case Grouping::kNesting:
      return place_of_pockets(run.severity->nested_pockets);
    case Grouping::kFamily:
      break;
  }
  return {kAfterAll, kUnknown};
}

/// The families in the order of the plan's worlds.
std::map<std::string, std::size_t> family_order(const BenchPlan& plan) {
  std::map<std::string, std::size_t> order;
  for (const BenchWorld& world : plan.worlds) order.emplace(world.family, order.size());
  return order;
}

void add(const RunResult& run, Group& group) {
  group.known += run.success.has_value() ? 1 : 0;
  group.successes += run.succeeded() ? 1 : 0;
  if (const auto ratio = run.path_ratio()) group.path_ratios.push_back(*ratio);
  if (!run.severity || !run.reached()) return;
  const RunResult::Severity& severity = *run.severity;
  ++group.arrived;
  group.above_bug1 += run.path_length_m > severity.bug1_bound_m ? 1 : 0;
  group.above_bug2 += run.path_length_m > severity.bug2_bound_m ? 1 : 0;
  if (!run.path_ratio()) return;
  group.bug1_ratios.push_back(severity.bug1_bound_m / *run.shortest_path_m);
  group.bug2_ratios.push_back(severity.bug2_bound_m / *run.shortest_path_m);
}

template <typename PlaceOf>
std::vector<Group> put_together(const BenchResults& results, const PlaceOf& place) {
  std::map<std::pair<Place, std::size_t>, Group> groups;
  for (std::size_t i = 0; i < results.plan->variants.size(); ++i) {
    std::map<Place, std::set<std::string>> worlds;
    for (const RunResult* run : results.samples_of(i)) {
      const Place of_run = place(*run);
      Group& group = groups[{of_run, i}];
      group.name = of_run.second;
      group.variant = i;
      add(*run, group);
      worlds[of_run].insert(run->key.world);
    }
    for (const auto& [of_run, names] : worlds) groups[{of_run, i}].worlds = names.size();
  }
  std::vector<Group> sorted;
  for (auto& [key, group] : groups) sorted.push_back(std::move(group));
  return sorted;
}

/// The cells of a group from its success on.
std::vector<std::string> cells_of(const Group& group) {
  const auto above = [&](std::size_t count) {
    return group.arrived == 0 ? "" : fmt::format("{} of {}", count, group.arrived);
  };
  return {group.known == 0 ? "" : share_text(group.successes, group.known),
          quantiles_text(group.path_ratios, "{:.2f}"),
          quantiles_text(group.bug1_ratios, "{:.2f}"),
          quantiles_text(group.bug2_ratios, "{:.2f}"),
          above(group.above_bug1),
          above(group.above_bug2)};
}

const std::vector<std::string>& columns_of_cells() {
  static const std::vector<std::string> columns = {"success",         "path / shortest",
                                                   "Bug1 / shortest", "Bug2 / shortest",
                                                   "above Bug1",      "above Bug2"};
  return columns;
}

std::string title_of(Grouping grouping) {
  switch (grouping) {
    case Grouping::kFamily:
      return "By family";
    case Grouping::kSeverity:
      return "By the depth of the deepest trap, in sensing ranges";
    case Grouping::kNesting:
      return "By the number of nested pockets";
    case Grouping::kBacktrack:
      return "By the necessary backtrack, in sensing ranges";
  }
  return {};
}

ordered_json quantiles_json(const std::vector<double>& values) {
  if (values.empty()) return nullptr;
  return {{"median", quantile(values, 0.5)}, {"q90", quantile(values, 0.9)}};
}

}  // namespace

std::vector<Group> groups_of(const BenchResults& results, Grouping grouping) {
  if (grouping != Grouping::kFamily) {
    return put_together(results, [&](const RunResult& run) { return place_of(run, grouping); });
  }
  const auto order = family_order(*results.plan);
  return put_together(results, [&](const RunResult& run) {
    return Place{order.at(run.family), run.family};
  });
}

Table group_table(const BenchResults& results, Grouping grouping) {
  Table table;
  table.title = title_of(grouping);
  table.note = kBugNote;
  table.columns = {"group", "graph", "worlds"};
  const auto& columns = columns_of_cells();
  table.columns.insert(table.columns.end(), columns.begin(), columns.end());
  for (const Group& group : groups_of(results, grouping)) {
    std::vector<std::string> row = {group.name, results.plan->variants[group.variant].label(),
                                    std::to_string(group.worlds)};
    for (std::string& cell : cells_of(group)) row.push_back(std::move(cell));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table bug_table(const BenchResults& results) {
  Table table;
  table.title = "Path lengths beside the bounds of Bug algorithms";
  table.note = kBugNote;
  table.columns = columns_of_cells();
  table.columns.front() = "graph";
  for (const Group& group : put_together(results, [](const RunResult&) {
         return Place{0, "all"};
       })) {
    if (group.arrived == 0) continue;
    std::vector<std::string> row = cells_of(group);
    row.front() = results.plan->variants[group.variant].label();
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::vector<std::string> group_lines(const BenchResults& results, Grouping grouping) {
  std::vector<std::string> lines;
  for (const Group& group : groups_of(results, grouping)) {
    const Variant& variant = results.plan->variants[group.variant];
    const Interval interval = wilson_interval(group.successes, group.known);
    ordered_json line;
    for (const GroupingName& known : kGroupings) {
      if (known.grouping == grouping) line["by"] = known.name;
    }
    line["group"] = group.name;
    line["graph"] = variant.graph;
    line["variant"] = variant.text();
    line["worlds"] = group.worlds;
    line["known"] = group.known;
    line["successes"] = group.successes;
    line["success_interval"] =
        group.known == 0 ? ordered_json(nullptr) : ordered_json({interval.low, interval.high});
    line["path_ratio"] = quantiles_json(group.path_ratios);
    line["bug1_ratio"] = quantiles_json(group.bug1_ratios);
    line["bug2_ratio"] = quantiles_json(group.bug2_ratios);
    line["arrived"] = group.arrived;
    line["above_bug1"] = group.above_bug1;
    line["above_bug2"] = group.above_bug2;
    lines.push_back(line.dump());
  }
  return lines;
}

}  // namespace clew::bench

// SPDX-License-Identifier: Apache-2.0
#include "bench/bench_page.hpp"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "files/whole_file.hpp"
#include "view/report.hpp"

namespace clew::bench {
namespace {

using nlohmann::ordered_json;

template <typename Value>
ordered_json or_null(const std::optional<Value>& value) {
  return value ? ordered_json(*value) : ordered_json(nullptr);
}

const char* name_of(CellRuns::Only only) {
  switch (only) {
    case CellRuns::Only::kCollided:
      return "collisions";
    case CellRuns::Only::kHit:
      return "hit_by";
    case CellRuns::Only::kStopped:
      return "safety_stops";
    case CellRuns::Only::kAll:
      break;
  }
  return "";
}

ordered_json to_json(const CellRuns& runs) {
  ordered_json json = ordered_json::object();
  if (runs.variant) json["variant"] = *runs.variant;
  if (!runs.family.empty()) json["family"] = runs.family;
  if (runs.solvable) json["solvable"] = or_null(*runs.solvable);
  if (runs.only != CellRuns::Only::kAll) json["with"] = name_of(runs.only);
  return json;
}

ordered_json to_json(const Table& table) {
  ordered_json json = {{"title", table.title}, {"note", table.note}, {"columns", table.columns}};
  json["rows"] = ordered_json::array();
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    ordered_json row = ordered_json::array();
    for (std::size_t k = 0; k < table.rows[i].size(); ++k) {
      ordered_json cell = {{"text", table.rows[i][k]}};
      if (i < table.runs.size() && k < table.runs[i].size() && table.runs[i][k].any()) {
        cell["runs"] = to_json(table.runs[i][k]);
      }
      row.push_back(std::move(cell));
    }
    json["rows"].push_back(std::move(row));
  }
  return json;
}

ordered_json to_json(const Chart& chart) {
  const auto ends = [](const std::optional<Interval>& interval) {
    return interval ? ordered_json{interval->low, interval->high} : ordered_json(nullptr);
  };
  ordered_json json = {{"title", chart.title},
                       {"note", chart.note},
                       {"unit", chart.unit},
                       {"axis", ends(chart.axis)},
                       {"points", ordered_json::array()}};
  for (const Chart::Point& point : chart.points) {
    json["points"].push_back({{"label", point.label},
                              {"value", point.value},
                              {"interval", ends(point.interval)},
                              {"runs", to_json(point.runs)}});
  }
  return json;
}

/// Only worlds of runs that are listed are named: there may be as many worlds as runs.
class ListedWorlds {
 public:
  explicit ListedWorlds(const BenchPlan& plan) : plan_(plan), places_(plan.worlds.size()) {}

  /// Where the world is in the list.
  std::size_t place_of(std::size_t world) {
    if (!places_[world]) {
      places_[world] = list_.size();
      list_.push_back({{"name", plan_.worlds[world].name}, {"family", plan_.worlds[world].family}});
    }
    return *places_[world];
  }
  ordered_json take() { return std::move(list_); }

 private:
  const BenchPlan& plan_;
  std::vector<std::optional<std::size_t>> places_;
  ordered_json list_ = ordered_json::array();
};

/// A run as the values of kRunColumns, in that order: ten thousand runs have names once.
constexpr const char* kRunColumns[] = {
    "run",      "variant",      "world",    "seed",   "outcome",      "success",
    "solvable", "ticks",        "time_s",   "path_m", "path_ratio",   "collisions",
    "hit_by",   "safety_stops", "captures", "alarms", "false_alarms", "hash"};

ordered_json to_json(const RunResult& run, std::size_t index, const BenchPlan& plan,
                     ListedWorlds& worlds) {
  const std::size_t seeds = plan.seeds.size();
  std::uint32_t alarms = 0;
  std::uint32_t false_alarms = 0;
  for (const auto& detector : run.detectors) {
    if (detector.shadow) continue;
    alarms += detector.alarms;
    false_alarms += detector.false_alarms;
  }
  return {index + 1,
          index / (plan.worlds.size() * seeds),
          worlds.place_of(index / seeds % plan.worlds.size()),
          run.key.seed,
          run.outcome,
          or_null(run.success),
          or_null(run.solvable),
          run.ticks,
          run.sim_time_s,
          run.path_length_m,
          or_null(run.path_ratio()),
          run.collisions,
          run.hit_by,
          run.safety_stops,
          or_null(run.captures),
          alarms,
          false_alarms,
          run.hash};
}

ordered_json runs_json(const BenchResults& results, const std::vector<KeptRun>& kept) {
  const BenchPlan& plan = *results.plan;
  const std::vector<std::size_t> listed = runs_on_page(results, kept, kMostRunsOnPage);
  ordered_json json;
  json["variants"] = ordered_json::array();
  for (const Variant& variant : plan.variants) json["variants"].push_back(variant.label());
  json["columns"] = kRunColumns;
  json["runs"] = ordered_json::array();
  ListedWorlds worlds(plan);
  for (const std::size_t i : listed) {
    json["runs"].push_back(to_json(results.runs[i], i, plan, worlds));
  }
  json["worlds"] = worlds.take();
  json["count"] = results.runs.size();
  json["kept"] = ordered_json::object();
  for (const KeptRun& run : kept) {
    json["kept"][std::to_string(run.index)] = {{"recording", run.recording},
                                               {"report", run.report}};
  }
  return json;
}

}  // namespace

std::vector<std::size_t> runs_on_page(const BenchResults& results, const std::vector<KeptRun>& kept,
                                      std::size_t most) {
  std::vector<std::size_t> listed;
  std::vector<bool> is_listed(results.runs.size());
  const auto list = [&](std::size_t run) {
    if (is_listed[run] || listed.size() >= most) return;
    is_listed[run] = true;
    listed.push_back(run);
  };
  for (const KeptRun& run : kept) list(run.index);
  for (std::size_t i = 0; i < results.runs.size(); ++i) {
    if (results.runs[i].success == false) list(i);
  }
  for (std::size_t i = 0; i < results.runs.size(); ++i) list(i);
  std::sort(listed.begin(), listed.end());
  return listed;
}

core::Result<std::string> bench_page(std::string_view page, const BenchResults& results,
                                     const Report& report, const std::vector<KeptRun>& kept,
                                     const std::string& directory) {
  ordered_json json = {{"title", report.title},           {"about", report.about},
                       {"remarks", report.remarks},       {"charts", ordered_json::array()},
                       {"tables", ordered_json::array()}, {"pictures", ordered_json::array()}};
  for (const Chart& chart : charts_of(results)) json["charts"].push_back(to_json(chart));
  for (const Table& table : report.tables) json["tables"].push_back(to_json(table));
  for (const Picture& picture : report.pictures) {
    const auto svg = files::read_file((std::filesystem::path(directory) / picture.file).string());
    if (!svg.ok()) return svg.error();
    json["pictures"].push_back({{"caption", picture.caption}, {"svg", *svg}});
  }
  json["runs"] = runs_json(results, kept);
  const std::string text = json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  return view::report(page, {{"bench.json", {text}}});
}

}  // namespace clew::bench

// SPDX-License-Identifier: Apache-2.0
#include "bench/run_result.hpp"

#include <nlohmann/json.hpp>
#include <tuple>

#include "bench/coverage.hpp"

namespace clew::bench {
namespace {

using nlohmann::json;

template <typename T>
std::optional<T> optional_at(const json& object, const char* key) {
  const json& value = object.at(key);
  return value.is_null() ? std::nullopt : std::optional<T>(value.get<T>());
}

RunResult::Detector read_detector(const json& object) {
  RunResult::Detector detector;
  detector.rule = object.at("rule").get<std::string>();
  detector.shadow = object.at("shadow").get<bool>();
  detector.alarms = object.at("alarms").get<std::uint32_t>();
  if (!object.contains("false_alarms")) return detector;
  detector.false_alarms = object.at("false_alarms").get<std::uint32_t>();
  detector.noticed = object.at("noticed").get<std::uint32_t>();
  detector.delays_s = object.at("delays_s").get<std::vector<double>>();
  detector.delays_m = object.at("delays_m").get<std::vector<double>>();
  return detector;
}

/// A world of which something is known has a number of nested pockets, be it 0.
std::optional<RunResult::Severity> read_severity(const json& object) {
  const auto nested_pockets = optional_at<std::uint32_t>(object, "nested_pockets");
  if (!nested_pockets) return std::nullopt;
  RunResult::Severity severity;
  severity.deepest_ranges = optional_at<double>(object, "severity_ranges");
  severity.nested_pockets = *nested_pockets;
  severity.backtrack_ranges = optional_at<double>(object, "necessary_backtrack_ranges");
  severity.bug1_bound_m = object.at("bug1_bound_m").get<double>();
  severity.bug2_bound_m = object.at("bug2_bound_m").get<double>();
  return severity;
}

RunKey read_key(const json& object) {
  return {object.at("graph").get<std::string>(), object.at("variant").get<std::string>(),
          object.at("world").get<std::string>(), object.at("seed").get<std::uint64_t>()};
}

RunResult read(const json& object) {
  RunResult run;
  run.key = read_key(object);
  run.family = object.at("family").get<std::string>();
  run.outcome = object.at("outcome").get<std::string>();
  run.success = optional_at<bool>(object, "success");
  run.solvable = optional_at<bool>(object, "solvable");
  run.ticks = object.at("ticks").get<std::uint64_t>();
  run.sim_time_s = object.at("sim_time_s").get<double>();
  run.path_length_m = object.at("path_length_m").get<double>();
  run.shortest_path_m = optional_at<double>(object, "shortest_path_m");
  run.collisions = object.at("collisions").get<std::uint32_t>();
  run.hit_by = object.at("hit_by").get<std::uint32_t>();
  run.safety_stops = object.at("safety_stops").get<std::uint32_t>();
  run.hash = optional_at<std::string>(object, "hash").value_or("");
  run.severity = read_severity(object);
  run.captures = optional_at<std::uint32_t>(object, "captures");
  run.held_at_end = optional_at<bool>(object, "held_at_end").value_or(false);
  if (object.contains("barn")) {
    const json& barn = object.at("barn");
    run.barn = BarnScore{barn.at("arrived").get<bool>(), barn.at("optimal_time_s").get<double>(),
                         barn.at("score").get<double>(), barn.at("score_2022").get<double>()};
  }
  for (const json& detector : object.at("detectors")) {
    run.detectors.push_back(read_detector(detector));
  }
  if (object.contains("coverage")) run.coverage = read_coverage(object.at("coverage"));
  return run;
}

}  // namespace

bool RunKey::operator<(const RunKey& other) const {
  return std::tie(graph, variant, world, seed) <
         std::tie(other.graph, other.variant, other.world, other.seed);
}

std::optional<double> RunResult::path_ratio() const {
  if (!reached() || !shortest_path_m || *shortest_path_m <= 0.0) return std::nullopt;
  return path_length_m / *shortest_path_m;
}

namespace {

template <typename Read>
auto read_line(const std::string& line, const Read& read) -> core::Result<decltype(read(json()))> {
  try {
    return read(json::parse(line));
  } catch (const json::exception& error) {
    return core::Error{std::string("is no line of results: ") + error.what()};
  }
}

}  // namespace

core::Result<RunKey> read_run_key(const std::string& line) { return read_line(line, read_key); }

core::Result<RunResult> read_run_result(const std::string& line) { return read_line(line, read); }

}  // namespace clew::bench

// SPDX-License-Identifier: Apache-2.0
#include "bench/timing.hpp"

#include <nlohmann/json.hpp>

#include "bench/line_file.hpp"

namespace clew::bench {

using core::Error;
using core::Result;
using nlohmann::ordered_json;

namespace {

constexpr const char* kKeys[] = {"graph", "variant", "world", "seed"};
constexpr const char* kMeasured[] = {"start_s", "wall_s", "ticks_per_s"};

bool is_of_one_run(const ordered_json& a, const ordered_json& b) {
  for (const char* key : kKeys) {
    if (!a.contains(key) || !b.contains(key) || a[key] != b[key]) return false;
  }
  return true;
}

ordered_json parse(const std::string* line) {
  return line == nullptr ? ordered_json() : ordered_json::parse(*line, nullptr, false);
}

}  // namespace

Result<TimedLine> take_timing(const std::string& line) {
  ordered_json result = parse(&line);
  if (!result.is_object()) return Error{"is no line of JSON"};
  ordered_json timing;
  for (const char* key : kKeys) timing[key] = result.value(key, ordered_json());
  for (const char* key : kMeasured) {
    timing[key] = result.value(key, ordered_json());
    result.erase(key);
  }
  return TimedLine{result.dump(), timing.dump()};
}

Result<void> visit_timed(const std::string& results_path, const std::string& timing_path,
                         const std::function<void(const std::string& line)>& visit) {
  auto results = LineReader::open(results_path);
  if (!results.ok()) return results.error();
  auto timings = LineReader::open(timing_path);
  if (!timings.ok()) return timings.error();
  results->next();  // what they depend on
  ordered_json timing = parse(timings->next());
  while (const std::string* line = results->next()) {
    ordered_json run = parse(line);
    if (!run.is_object()) {
      return core::Error{"is no line of results", results_path, results->number(), 0};
    }
    const bool is_timed = is_of_one_run(run, timing);
    for (const char* key : kMeasured) run[key] = is_timed ? timing[key] : ordered_json();
    visit(run.dump());
    if (is_timed) timing = parse(timings->next());
  }
  return results->is_whole();
}

}  // namespace clew::bench

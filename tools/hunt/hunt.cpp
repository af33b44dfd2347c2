// SPDX-License-Identifier: Apache-2.0
#include "hunt/hunt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "bench/worker_pool.hpp"
#include "core/random.hpp"
#include "files/whole_file.hpp"
#include "hunt/case_file.hpp"

namespace clew::hunt {
namespace {

using core::Result;
using nlohmann::ordered_json;

namespace fs = std::filesystem;

constexpr std::size_t kGeneration = 16;
constexpr std::size_t kMostParents = 12;
constexpr double kByChance = 0.25;
constexpr std::uint32_t kParentStream = 0x706172;  // of the choice of parents

ordered_json or_null(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? ordered_json(*value) : ordered_json(nullptr);
}

ordered_json values_json(const FieldValues& values) {
  ordered_json json;
  for (std::size_t i = 0; i < kFields; ++i) {
    const FieldInfo& info = fields()[i];
    const auto field = static_cast<Field>(i);
    const auto& value = values[field];
    if (!value) {
      json[info.name] = nullptr;
    } else if (info.type == FieldType::kWord) {
      json[info.name] = values.word(field);
    } else if (info.type == FieldType::kFlag) {
      json[info.name] = *value != 0.0;
    } else {
      json[info.name] = or_null(value);
    }
  }
  return json;
}

/// A run as a worker tells of it.
ordered_json head_of(const HuntRun& run, const RunCase& which) {
  ordered_json json = {{"run", run.index}};
  json["parent"] = run.parent ? ordered_json(*run.parent) : ordered_json(nullptr);
  json["world"] = which.world_file;
  json["seed"] = which.seed;
  json["set"] = which.graph.set;
  return json;
}

Result<void> work_on(const HuntRun& run, const HuntSpace& space, const Property& property,
                     const Workshop& workshop, const bench::Emit& emit) {
  const auto which = realise(run.candidate, space, workshop.configs);
  if (!which.ok()) return which.error();
  ordered_json json = head_of(run, *which);
  const auto outcome = run_case(*which, property, workshop);
  if (!outcome.ok()) {
    json["refused"] = outcome.error().text();
    emit(json.dump());
    return {};
  }
  if (!*outcome) return {};
  const Verdict verdict = property.judge((*outcome)->values);
  json["holds"] = verdict.holds ? ordered_json(*verdict.holds) : ordered_json(nullptr);
  json["robustness"] = or_null(verdict.robustness);
  json.update(values_json((*outcome)->values));
  json["hash"] = (*outcome)->hash;
  emit(json.dump());
  return {};
}

Result<void> take_line(const std::string& line, std::vector<HuntRun>& runs) {
  const auto json = ordered_json::parse(line, nullptr, false);
  if (json.is_discarded()) return core::Error{"a worker's line is no JSON"};
  HuntRun& run = runs.at(json.at("run").get<std::size_t>());
  run.line = line;
  run.world = json.at("world").get<std::string>();
  if (json.contains("refused")) {
    run.refused = json.at("refused").get<std::string>();
    return {};
  }
  if (!json.at("holds").is_null()) {
    run.verdict.holds = json.at("holds").get<bool>();
    run.verdict.robustness = json.at("robustness").get<double>();
  }
  run.outcome = json.at("outcome").get<std::string>();
  run.hash = json.at("hash").get<std::string>();
  return {};
}

/// The nearest misses, the best of each world, best first.
std::vector<std::size_t> parents_of(const std::vector<HuntRun>& runs, std::size_t count) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < count; ++i) {
    if (runs[i].verdict.holds == true) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return *runs[a].verdict.robustness < *runs[b].verdict.robustness;
  });
  std::vector<std::size_t> parents;
  for (const std::size_t index : order) {
    const bool is_known = std::any_of(parents.begin(), parents.end(), [&](std::size_t other) {
      return runs[other].candidate.is_same_world(runs[index].candidate);
    });
    if (!is_known) parents.push_back(index);
    if (parents.size() == kMostParents) break;
  }
  return parents;
}

/// The next run, a function of those of the generations before.
HuntRun next_run(std::size_t index, const std::vector<std::size_t>& parents,
                 const std::vector<HuntRun>& runs, const HuntSpace& space,
                 const HuntOptions& options) {
  HuntRun run;
  run.index = index;
  const core::Random random({options.seed, 0, kParentStream, index});
  const bool is_guided = index >= options.runs / 3 && !parents.empty();
  if (!is_guided || random.uniform(0) < kByChance) {
    run.candidate = draw_candidate(space, options.seed, index);
    return run;
  }
  // The first ones more often: the square of a share.
  const double share = random.uniform(1) * random.uniform(1);
  run.parent = parents[static_cast<std::size_t>(share * static_cast<double>(parents.size()))];
  run.candidate = mutate_candidate(runs[*run.parent].candidate, space, options.seed, index);
  return run;
}

std::size_t count_if(const std::vector<HuntRun>& runs, bool (*is)(const HuntRun&)) {
  return static_cast<std::size_t>(std::count_if(runs.begin(), runs.end(), is));
}

Result<std::string> write_case(const HuntRun& run, const HuntSpace& space, const Property& property,
                               const Workshop& workshop, const fs::path& directory) {
  const auto which = realise(run.candidate, space, workshop.configs);
  if (!which.ok()) return which.error();
  const fs::path folder = directory / fmt::format("{:05}", run.index);
  CLEW_RETURN_IF_ERROR(files::make_directory(folder));
  CLEW_RETURN_IF_ERROR(files::write_file(folder / "world.yaml", which->world_text));
  CaseFile file;
  file.about = fmt::format("run {} of a hunt: {} in {}", run.index, run.outcome, run.world);
  file.property = property.text();
  file.graph = which->graph;
  file.world = "world.yaml";
  file.seed = which->seed;
  file.outcome = run.outcome;
  file.hash = run.hash;
  const std::string text =
      "# " + command_line(which->graph, (folder / "world.yaml").string(), which->seed) + '\n' +
      case_text(file);
  const std::string path = (folder / "case.yaml").string();
  CLEW_RETURN_IF_ERROR(files::write_file(path, text));
  return path;
}

}  // namespace

std::size_t HuntEnd::failures() const {
  return count_if(runs, [](const HuntRun& run) { return run.failed(); });
}
std::size_t HuntEnd::held() const {
  return count_if(runs, [](const HuntRun& run) { return run.verdict.holds == true; });
}
std::size_t HuntEnd::refusals() const {
  return count_if(runs, [](const HuntRun& run) { return !run.refused.empty(); });
}

Result<HuntEnd> hunt(const HuntSpace& space, const Property& property, const Workshop& workshop,
                     const HuntOptions& options) {
  HuntEnd end;
  while (end.runs.size() < options.runs) {
    const std::size_t first = end.runs.size();
    const std::size_t last = std::min(first + kGeneration, options.runs);
    const std::vector<std::size_t> parents = parents_of(end.runs, first);
    std::vector<std::size_t> units;
    for (std::size_t index = first; index < last; ++index) {
      end.runs.push_back(next_run(index, parents, end.runs, space, options));
      units.push_back(index);
    }
    bench::PoolOptions pool;
    pool.workers = options.jobs;
    std::size_t done = first;
    pool.on_line = [&](const std::string& line) -> Result<void> {
      CLEW_RETURN_IF_ERROR(take_line(line, end.runs));
      if (options.progress) options.progress(++done, end.failures());
      return {};
    };
    const auto pool_end = bench::run_in_workers(
        units,
        [&](std::size_t unit, const bench::Emit& emit) {
          return work_on(end.runs[unit], space, property, workshop, emit);
        },
        pool);
    if (!pool_end.ok()) return pool_end.error();
    if (pool_end->interrupted_by != 0) {
      end.interrupted_by = pool_end->interrupted_by;
      end.runs.resize(first);  // generations are whole
      return end;
    }
    if (end.refusals() == end.runs.size()) {
      return core::Error{"no run could be made; the first: " + end.runs.front().refused};
    }
  }
  return end;
}

Result<std::vector<std::string>> write_hunt(const HuntEnd& end, const HuntSpace& space,
                                            const Property& property, const Workshop& workshop,
                                            const std::string& directory) {
  const fs::path root(directory);
  CLEW_RETURN_IF_ERROR(files::make_directory(root / "cases"));
  std::string lines;
  std::vector<std::string> paths;
  for (const HuntRun& run : end.runs) {
    lines += run.line + '\n';
    if (!run.failed()) continue;
    auto path = write_case(run, space, property, workshop, root / "cases");
    if (!path.ok()) return path.error();
    paths.push_back(std::move(path).value());
  }
  CLEW_RETURN_IF_ERROR(files::write_file(root / "runs.jsonl", lines));
  return paths;
}

}  // namespace clew::hunt

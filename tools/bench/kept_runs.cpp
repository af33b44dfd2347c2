// SPDX-License-Identifier: Apache-2.0
#include "bench/kept_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <regex>

#include "bench/worker_pool.hpp"
#include "bench/world_bench.hpp"
#include "bench/world_names.hpp"
#include "files/whole_file.hpp"
#include "view/report.hpp"

namespace clew::bench {
namespace {

using core::Result;
namespace fs = std::filesystem;

/// Those of a variant that failed, the worst first; of equal ones the first.
std::vector<const RunResult*> failed_of(const BenchResults& results, std::size_t variant) {
  std::vector<const RunResult*> failed = results.samples_of(variant);
  failed.erase(std::remove_if(failed.begin(), failed.end(),
                              [](const RunResult* run) { return badness(*run) == 0; }),
               failed.end());
  const bool all_know_shortest = std::all_of(failed.begin(), failed.end(), [](const auto* run) {
    return run->shortest_path_m.has_value();
  });
  const auto length = [&](const RunResult& run) {
    return run.path_length_m / (all_know_shortest ? *run.shortest_path_m : 1.0);
  };
  std::stable_sort(failed.begin(), failed.end(), [&](const RunResult* a, const RunResult* b) {
    if (badness(*a) != badness(*b)) return badness(*a) > badness(*b);
    return length(*a) > length(*b);
  });
  return failed;
}

/// Variant, world and seed of a run, by its place in the bench's order.
struct RunPlace {
  std::size_t variant;
  std::size_t world;
  std::uint64_t seed;
};

RunPlace place_of(const BenchPlan& plan, std::size_t index) {
  const std::size_t seeds = plan.seeds.size();
  const std::size_t worlds = plan.worlds.size();
  return {index / (worlds * seeds), index / seeds % worlds, plan.seeds[index % seeds]};
}

std::string name_of(const BenchPlan& plan, std::size_t index) {
  const RunPlace place = place_of(plan, index);
  return fmt::format("runs/{:02}-{}-{}", place.variant + 1,
                     file_name_of(plan.worlds[place.world].name), place.seed);
}

Result<void> write_report(const std::string& recording, const std::string& report,
                          std::string_view page) {
  auto bytes = files::read_file(recording);
  if (!bytes.ok()) return bytes.error();
  const auto text =
      view::report(page, {{fs::path(recording).filename().string(), {std::move(bytes).value()}}});
  if (!text.ok()) return text.error();
  return files::write_file(report, *text);
}

/// Removes what an earlier bench kept, by its names: a folder `runs` of somebody's may hold more.
void remove_kept(const fs::path& folder) {
  static const std::regex kKept(R"(\d{2,}-.+-\d+\.(mcap|html))");
  std::vector<fs::path> old;
  std::error_code ignored;
  for (fs::directory_iterator file(folder, ignored), end; !ignored && file != end;
       file.increment(ignored)) {
    if (std::regex_match(file->path().filename().string(), kKept)) old.push_back(file->path());
  }
  for (const fs::path& file : old) fs::remove(file, ignored);
  fs::remove(folder, ignored);  // if nothing else is in it
}

}  // namespace

int badness(const RunResult& run) {
  if (run.collisions > 0) return 2;
  return run.success.value_or(true) ? 0 : 1;
}

std::vector<std::size_t> failed_runs(const BenchResults& results, std::size_t most) {
  std::vector<std::vector<const RunResult*>> failed;
  for (std::size_t i = 0; i < results.plan->variants.size(); ++i) {
    failed.push_back(failed_of(results, i));
  }
  std::vector<std::size_t> chosen;
  for (std::size_t rank = 0, found = 1; found > 0 && chosen.size() < most; ++rank) {
    found = 0;
    for (const auto& of_variant : failed) {
      if (rank >= of_variant.size() || chosen.size() >= most) continue;
      ++found;
      chosen.push_back(static_cast<std::size_t>(of_variant[rank] - results.runs.data()));
    }
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

Result<KeptRuns> keep_failed_runs(const BenchResults& results, const runtime::ConfigPath& configs,
                                  const std::vector<runtime::StageInfo>& stages,
                                  const std::string& directory, const KeepOptions& options) {
  const BenchPlan& plan = *results.plan;
  std::vector<KeptRun> kept;
  for (const std::size_t index : failed_runs(results, options.most)) {
    const std::string name = name_of(plan, index);
    kept.push_back({index, name + ".mcap", options.page.empty() ? "" : name + ".html"});
  }
  remove_kept(fs::path(directory) / "runs");
  if (kept.empty()) return KeptRuns{};
  CLEW_RETURN_IF_ERROR(files::make_directory(fs::path(directory) / "runs"));
  const Work work = [&](std::size_t unit, const Emit&) -> Result<void> {
    const KeptRun& run = kept[unit];
    const RunPlace place = place_of(plan, run.index);
    const std::string recording = (fs::path(directory) / run.recording).string();
    WorldBench bench(plan, place.world, configs, stages);
    CLEW_RETURN_IF_ERROR(bench.record(plan.variants[place.variant], place.seed, recording));
    if (run.report.empty()) return {};
    return write_report(recording, (fs::path(directory) / run.report).string(), options.page);
  };
  std::vector<std::size_t> units(kept.size());
  std::iota(units.begin(), units.end(), std::size_t{0});
  PoolOptions pool;
  pool.workers = options.jobs;
  pool.on_line = [](const std::string&) { return Result<void>(); };
  const auto end = run_in_workers(units, work, pool);
  if (!end.ok()) return end.error();
  if (end->interrupted_by != 0) return KeptRuns{end->interrupted_by, {}};
  return KeptRuns{0, std::move(kept)};
}

}  // namespace clew::bench

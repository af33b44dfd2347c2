// SPDX-License-Identifier: Apache-2.0
#include "bench/worst_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "bench/world_bench.hpp"
#include "bench/world_names.hpp"
#include "plot/plot.hpp"

namespace clew::bench {
namespace {

constexpr std::size_t kMostPictures = 12;

std::string caption_of(const Variant& variant, const RunResult& run) {
  std::string text = fmt::format("{} in {}, seed {}: {}, path {:.1f} m", variant.label(),
                                 run.key.world, run.key.seed, run.outcome, run.path_length_m);
  if (const auto ratio = run.path_ratio()) text += fmt::format(" ({:.2f} x shortest)", *ratio);
  return text;
}

}  // namespace

std::size_t worst_of(const std::vector<const RunResult*>& runs) {
  int most = 0;
  for (const RunResult* run : runs) most = std::max(most, badness(*run));
  bool all_know_shortest = true;
  for (const RunResult* run : runs) {
    if (badness(*run) == most && !run->shortest_path_m) all_know_shortest = false;
  }
  std::size_t worst = runs.size();
  double longest = 0.0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (badness(*runs[i]) != most) continue;
    const double shortest_m = all_know_shortest ? *runs[i]->shortest_path_m : 1.0;
    const double length = runs[i]->path_length_m / shortest_m;
    if (worst < runs.size() && length <= longest) continue;
    worst = i;
    longest = length;
  }
  return worst;
}

core::Result<std::vector<Picture>> draw_worst_runs(const BenchResults& results,
                                                   const runtime::ConfigPath& configs,
                                                   const std::vector<runtime::StageInfo>& stages,
                                                   const std::string& directory,
                                                   const std::vector<KeptRun>& kept) {
  const BenchPlan& plan = *results.plan;
  const std::size_t seeds = plan.seeds.size();
  std::vector<Picture> pictures;
  for (std::size_t i = 0; i < plan.variants.size() && i < kMostPictures; ++i) {
    const auto runs = results.of_variant(i);
    const std::size_t worst = worst_of(runs);
    const RunResult& run = *runs[worst];
    const std::string name =
        fmt::format("pictures/{:02}-{}-{}", i + 1, file_name_of(run.key.world), run.key.seed);
    const std::string path = (std::filesystem::path(directory) / name).string();
    const auto index = static_cast<std::size_t>(&run - results.runs.data());
    const auto there = std::find_if(kept.begin(), kept.end(),
                                    [&](const KeptRun& each) { return each.index == index; });
    if (there != kept.end()) {
      const auto recording = std::filesystem::path(directory) / there->recording;
      CLEW_RETURN_IF_ERROR(plot::plot_recordings({recording.string()}, path + ".svg"));
    } else {
      WorldBench bench(plan, worst / seeds, configs, stages);
      CLEW_RETURN_IF_ERROR(bench.record(plan.variants[i], run.key.seed, path + ".mcap"));
      CLEW_RETURN_IF_ERROR(plot::plot_recordings({path + ".mcap"}, path + ".svg"));
      std::error_code ignored;
      std::filesystem::remove(path + ".mcap", ignored);
    }
    pictures.push_back({name + ".svg", caption_of(plan.variants[i], run)});
  }
  return pictures;
}

}  // namespace clew::bench

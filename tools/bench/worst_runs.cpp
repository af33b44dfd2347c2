// SPDX-License-Identifier: Apache-2.0
#include "bench/worst_runs.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "bench/world_bench.hpp"
#include "plot/plot.hpp"

namespace clew::bench {
namespace {

constexpr std::size_t kMostPictures = 12;

/// The greater, the worse; path ratios are far below the steps of 1e6.
double badness(const RunResult& run) {
  if (run.collisions > 0) return 2e6;
  if (!run.success) return 1e6;
  return run.path_ratio().value_or(0.0);
}

std::string caption_of(const Variant& variant, const RunResult& run) {
  std::string text = fmt::format("{} in {}, seed {}: {}, path {:.1f} m", variant.label(),
                                 run.key.world, run.key.seed, run.outcome, run.path_length_m);
  if (const auto ratio = run.path_ratio()) text += fmt::format(" ({:.2f} x shortest)", *ratio);
  return text;
}

}  // namespace

core::Result<std::vector<Picture>> draw_worst_runs(const BenchResults& results,
                                                   const runtime::ConfigPath& configs,
                                                   const std::vector<runtime::StageInfo>& stages,
                                                   const std::string& directory) {
  const BenchPlan& plan = *results.plan;
  const std::size_t seeds = plan.seeds.size();
  std::vector<Picture> pictures;
  for (std::size_t i = 0; i < plan.variants.size() && i < kMostPictures; ++i) {
    const auto runs = results.of_variant(i);
    std::size_t worst = 0;
    for (std::size_t k = 1; k < runs.size(); ++k) {
      if (badness(*runs[k]) > badness(*runs[worst])) worst = k;
    }
    const RunResult& run = *runs[worst];
    const std::string name =
        fmt::format("pictures/{:02}-{}-{}", i + 1, plan.worlds[worst / seeds].name, run.key.seed);
    const std::string path = (std::filesystem::path(directory) / name).string();
    WorldBench bench(plan, worst / seeds, configs, stages);
    CLEW_RETURN_IF_ERROR(bench.record(plan.variants[i], run.key.seed, path + ".mcap"));
    CLEW_RETURN_IF_ERROR(plot::plot_recordings({path + ".mcap"}, path + ".svg"));
    std::error_code ignored;
    std::filesystem::remove(path + ".mcap", ignored);
    pictures.push_back({name + ".svg", caption_of(plan.variants[i], run)});
  }
  return pictures;
}

}  // namespace clew::bench

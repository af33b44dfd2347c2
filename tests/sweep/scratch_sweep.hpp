// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <filesystem>

#include "../recording/scratch_directory.hpp"
#include "bench/results_file.hpp"
#include "bench/run_order.hpp"
#include "bench/shards.hpp"
#include "sweep/shard_folders.hpp"

namespace clew::sweep_test {

/// A bench of two variants in five worlds with three seeds, in a directory of its own.
class ScratchSweep {
 public:
  ScratchSweep() {
    plan.suite = "test";
    plan.seeds = {1, 2, 3};
    for (const char* world : {"a", "b", "c", "d", "e"}) plan.worlds.push_back({"f", world, {}});
    plan.variants = {{"g", {}, {}}, {"h", {}, {}}};
    plan.configuration = {{"suite", "test"}};
    order.suite = "test";
  }

  std::string directory() const { return scratch_.file("out"); }
  std::string shard(std::size_t number) const {
    return directory() + "/shards/" + std::to_string(number);
  }

  /// Does what a task does: more runs of a shard.
  void run_more(std::size_t number, std::size_t count, std::size_t runs) const {
    std::filesystem::create_directories(shard(number));
    bench::ResultsHeader header{order, plan.configuration};
    header.configuration[bench::kShardKey] = bench::Shard{number, count}.text();
    std::size_t there = 0;
    auto file = bench::ResultsFile::open(shard(number) + '/' + bench::kResultsFile, header, false,
                                         [&](const std::string&, int) {
                                           ++there;
                                           return core::Result<void>();
                                         });
    auto timing = bench::LineFile::open(shard(number) + '/' + bench::kTimingFile);
    const std::vector<std::string> lines = lines_of(number, count);
    for (std::size_t i = there; i < std::min(there + runs, lines.size()); ++i) {
      if (!file->append(lines[i]).ok() || !timing->append(lines[i]).ok()) std::abort();
    }
  }

  bench::BenchPlan plan;
  bench::BenchOrder order;

 private:
  std::vector<std::string> lines_of(std::size_t number, std::size_t count) const {
    const bench::Shards shards(plan, count);
    const bench::RunOrder runs(plan);
    std::vector<std::string> lines;
    for (const bench::Unit& unit : shards.units_of(number, 1)) {
      for (std::size_t run = unit.first; run < unit.end; ++run) {
        const auto key = runs.key_of(runs.index_of(run / 3, unit.world, run % 3));
        lines.push_back(fmt::format(R"({{"graph":"{}","variant":"","world":"{}","seed":{}}})",
                                    key.graph, key.world, key.seed));
      }
    }
    return lines;
  }

  recording_test::ScratchDirectory scratch_;
};

}  // namespace clew::sweep_test

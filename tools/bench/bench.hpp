// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "bench/bench_plan.hpp"
#include "bench/report.hpp"

namespace clew::bench {

struct BenchOptions {
  std::string directory;  ///< for results, report, pictures and generated worlds
  std::size_t jobs = 1;   ///< worker processes
  bool restart = false;   ///< drop existing results
  /// Called after each run; `found` of the `done` ones were there before. May be null.
  std::function<void(std::size_t found, std::size_t done, std::size_t total)> progress;
};

/// A bench that came to its end, or was interrupted.
struct BenchEnd {
  int interrupted_by = 0;          ///< a signal; then the rest is empty
  std::vector<std::string> lines;  ///< of results, JSON, in the bench's order
  Report report;
};

/// Runs what has no result in the directory yet, then writes `results.csv`, `report.md`,
/// `report.html` and pictures of each variant's worst run. The results do not depend on the number
/// of jobs, nor on interruptions, but for `wall_s` and `ticks_per_s`.
core::Result<BenchEnd> run_bench(const BenchPlan& plan, const runtime::ConfigPath& configs,
                                 const std::vector<runtime::StageInfo>& stages,
                                 const BenchOptions& options);

/// Writes the plan's generated worlds, each as a world file and a picture. The number of them.
core::Result<std::size_t> write_worlds(const BenchPlan& plan, const std::string& directory);

}  // namespace clew::bench

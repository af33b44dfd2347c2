// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "bench/bench_order.hpp"
#include "bench/bench_page.hpp"
#include "bench/bench_plan.hpp"
#include "bench/report.hpp"
#include "bench/shards.hpp"

namespace clew::bench {

struct BenchOptions {
  std::string directory;  ///< for results, report, pictures and generated worlds
  std::size_t jobs = 1;   ///< worker processes
  bool restart = false;   ///< drop existing results
  bool compress = false;  ///< results and timing, however small
  std::size_t keep = 0;   ///< recordings of so many runs that failed, at most
  Pages pages;            ///< to put results and recordings into
  Shard shard;            ///< which runs
  /// Called after each run; `found` of the `done` ones were there before. May be null.
  std::function<void(std::size_t found, std::size_t done, std::size_t total)> progress;
};

/// A bench that came to its end, or was interrupted.
struct BenchEnd {
  int interrupted_by = 0;  ///< a signal; then the rest is empty
  std::size_t runs = 0;
  Report report;  ///< empty for a shard
};

/// Runs what has no result in the directory yet, then puts the results in the bench's order and
/// writes `results.csv`, `groups.jsonl`, `report.md`, `report.html`, pictures of each variant's
/// worst run and recordings of runs that failed. Of all these files no byte depends on the number
/// of jobs or on interruptions. What a clock measured is in `timing.jsonl`. A shard has results and
/// timing only.
core::Result<BenchEnd> run_bench(const BenchPlan& plan, const BenchOrder& order,
                                 const runtime::ConfigPath& configs,
                                 const std::vector<runtime::StageInfo>& stages,
                                 const BenchOptions& options);

/// Puts the results and the timing of a directory in the bench's order, whoever has written them.
core::Result<void> put_in_order(const BenchPlan& plan, const std::string& directory);

/// Puts results and timing that an end has compressed back, to go on with them; with `restart` they
/// are dropped.
core::Result<void> expand_results(const std::string& directory, bool restart);

/// Writes what follows from results that are whole: report, table, pictures, generated worlds. Last
/// it compresses results and timing where they are large.
core::Result<BenchEnd> finish_bench(const BenchPlan& plan, const runtime::ConfigPath& configs,
                                    const std::vector<runtime::StageInfo>& stages,
                                    const BenchOptions& options);

/// Calls `visit` with each run of a bench or shard that came to its end, in order, as one line:
/// results and timing.
core::Result<void> visit_runs(const std::string& directory,
                              const std::function<void(const std::string& line)>& visit);

/// Writes the plan's generated worlds, each as a world file and a picture. The number of them.
core::Result<std::size_t> write_worlds(const BenchPlan& plan, const std::string& directory);

}  // namespace clew::bench

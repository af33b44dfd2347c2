// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "bench/bench.hpp"

namespace clew::tools {

/// The options of a bench on a cluster, and of its cost.
struct BenchSweepOptions {
  std::string on;          ///< `slurm[:PARTITION]`; empty: on this machine
  std::size_t shards = 0;  ///< 0: two a core
  std::size_t cores = 1;   ///< of a task
  bool dry_run = false;
  bool json = false;
};

void add_sweep(CLI::App& app, BenchSweepOptions& options);

/// A rough time for people.
std::string duration_text(double seconds);

/// Runs a bench on a cluster, in `bench.directory`, and merges its shards there.
core::Result<bench::BenchEnd> run_on_cluster(const bench::BenchPlan& plan,
                                             const bench::BenchOrder& order,
                                             const runtime::ConfigPath& configs,
                                             const bench::BenchOptions& bench,
                                             const BenchSweepOptions& options);

/// Runs a sample and prints what the bench will cost, here or on a cluster.
core::Result<void> print_cost(const bench::BenchPlan& plan, const runtime::ConfigPath& configs,
                              const bench::BenchOptions& bench, const BenchSweepOptions& options);

}  // namespace clew::tools

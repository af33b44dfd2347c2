// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/bench_order.hpp"
#include "bench/bench_plan.hpp"
#include "sweep/job_queue.hpp"

namespace clew::sweep {

/// How far a sweep is.
struct SweepProgress {
  std::size_t found = 0;  ///< runs that were there before
  std::size_t done = 0;   ///< with those
  std::size_t total = 0;
  std::size_t waiting = 0;  ///< tasks
  std::size_t running = 0;
};

struct SweepOptions {
  std::string directory;   ///< of the whole; shards, their logs and the script are in its `shards`
  std::string program;     ///< the path of clew, on every node
  std::size_t shards = 0;  ///< 0: as many as the sweep was begun with, else two a core of the queue
  std::size_t cores = 1;   ///< of a task
  bool restart = false;    ///< drop existing shards
  /// Waits so many seconds; false if the sweep is to be given up.
  std::function<bool(double seconds)> wait;
  std::function<void(const SweepProgress&)> progress;
  /// Takes a sentence for the user.
  std::function<void(const std::string&)> say;
};

struct SweepEnd {
  bool is_cancelled = false;             ///< then the rest is empty
  std::vector<std::string> directories;  ///< of the shards, all whole and in order
};

/// Runs a bench as an array of shards on a cluster, which sees the same files under the same paths.
/// Shards that end before they are whole are submitted again and go on from where they were, as
/// long as each gets on: one that ended three times without another run is an error, with the last
/// line of its log. An array of the same sweep that is still in the queue is taken up again.
core::Result<SweepEnd> run_sweep(const bench::BenchPlan& plan, const bench::BenchOrder& order,
                                 const SweepOptions& options, JobQueue& queue);

/// The number of shards for so many cores, two each: so that the longest shard does not hold up
/// all.
std::size_t default_shards(const bench::BenchPlan& plan, std::size_t cores,
                           std::size_t cores_of_task);

}  // namespace clew::sweep

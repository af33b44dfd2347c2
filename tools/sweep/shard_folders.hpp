// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bench/bench_order.hpp"
#include "bench/bench_plan.hpp"

namespace clew::sweep {

/// What a sweep keeps in its folder `shards`: what it is (`sweep.jsonl`), the script of a task
/// (`task.sh`), the id of its job (`job`), and of each shard a directory and a log.
class ShardFolders {
 public:
  /// Makes the folder, or takes up the one that is there. Refused: one of another bench or with
  /// another number of shards; `count` 0 takes the number that is there.
  static core::Result<ShardFolders> open(const std::string& directory, const bench::BenchPlan& plan,
                                         const bench::BenchOrder& order, std::size_t count);
  /// The number of shards that a sweep in this directory was begun with; 0: there is none.
  static core::Result<std::size_t> count_in(const std::string& directory);

  std::size_t count() const { return runs_.size(); }
  std::string shard(std::size_t number) const;
  std::string script() const { return folder_ + "/task.sh"; }
  std::string log_pattern() const { return folder_ + "/%a.log"; }
  /// The last line of a shard's log; empty without one.
  std::string last_words(std::size_t number) const;

  /// How many runs a shard has when it is whole, and how many it has now.
  std::size_t runs(std::size_t number) const { return runs_[number - 1]; }
  std::size_t done(std::size_t number);
  bool is_whole(std::size_t number) { return done(number) >= runs(number); }

  /// The id of the job that was noted last; empty: none.
  std::string job() const;
  core::Result<void> note_job(const std::string& job) const;
  core::Result<void> write_script(const std::string& program, const bench::BenchOrder& order,
                                  std::size_t cores) const;

 private:
  /// How far the lines of a shard's results have been counted.
  struct Count {
    std::uint64_t bytes = 0;
    std::size_t lines = 0;
  };
  ShardFolders(std::string folder, const bench::BenchPlan& plan, std::size_t count);

  std::string folder_;
  std::vector<std::size_t> runs_;
  std::vector<Count> counts_;
};

}  // namespace clew::sweep

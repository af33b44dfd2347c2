// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "bench/bench.hpp"
#include "bench/results_file.hpp"
#include "bench/shards.hpp"

namespace clew::bench {

/// What a directory holds of a shard.
struct ShardDirectory {
  std::string path;
  ResultsHeader header;  ///< its configuration without `shard`
  Shard shard;
};

/// Looks at the directories of shards, in any order, and puts them in order. Refused: what is no
/// shard, shards of different benches (the difference is named), a shard twice, and one that is
/// missing.
core::Result<std::vector<ShardDirectory>> read_shards(const std::vector<std::string>& directories);

/// Merges the lines of all shards of a bench, in order, into files of a directory: results under
/// this header, and timing. The shards are read side by side, a line of each at a time. Refused: a
/// shard that is not whole, has runs of another, or has one twice.
core::Result<void> merge_lines(const BenchPlan& plan, const ResultsHeader& header,
                               const std::vector<ShardDirectory>& shards,
                               const std::string& directory);

/// Merges all shards of a bench into `options.directory`, byte for byte what one bench without
/// shards would have written, but for `timing.jsonl`. Refused: shards made with another
/// configuration than the plan's, and what merge_lines refuses.
core::Result<BenchEnd> merge_shards(const BenchPlan& plan, const BenchOrder& order,
                                    const std::vector<ShardDirectory>& shards,
                                    const runtime::ConfigPath& configs,
                                    const std::vector<runtime::StageInfo>& stages,
                                    const BenchOptions& options);

}  // namespace clew::bench

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bench/bench_plan.hpp"

namespace clew::bench {

/// The most shards of a bench: a merge has a file of each open.
constexpr std::size_t kMostShards = 1000;

/// One of `count` parts of a bench, from 1; 1 of 1 is all of it.
struct Shard {
  std::size_t number = 1;
  std::size_t count = 1;

  /// `2/4`.
  std::string text() const { return std::to_string(number) + '/' + std::to_string(count); }
};

/// Reads `I/N`. Refused: anything else, and I out of 1 to N.
core::Result<Shard> read_shard(const std::string& text);

/// What a worker does at a time: consecutive runs of a world, numbered by variant, then seed.
struct Unit {
  std::size_t world = 0;
  std::size_t first = 0;
  std::size_t end = 0;
};

/// A bench in shards. Worlds are dealt out in turn, so that each shard has a share of each family,
/// and what is computed of a world is computed in one shard. Where a shard would get fewer than
/// four worlds, worlds are cut into pieces of their runs, and the pieces are dealt out.
class Shards {
 public:
  Shards(const BenchPlan& plan, std::size_t count);

  /// The shard, from 1, of a run of a world, numbered by variant, then seed.
  std::size_t of(std::size_t world, std::size_t run) const;
  /// The units of a shard, in order, for so many workers: where these would get fewer than four
  /// each, cut into smaller ones, but not below 16 runs.
  std::vector<Unit> units_of(std::size_t number, std::size_t workers) const;

 private:
  std::size_t count_;
  std::size_t worlds_;
  std::size_t runs_;  ///< of a world
  std::size_t pieces_;
};

}  // namespace clew::bench

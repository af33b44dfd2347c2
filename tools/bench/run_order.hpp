// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "bench/bench_plan.hpp"
#include "bench/run_result.hpp"

namespace clew::bench {

/// The number of each run in a bench, from 0: by variant, then world, then seed. Files of results
/// and tables are in this order.
class RunOrder {
 public:
  explicit RunOrder(const BenchPlan& plan);

  std::size_t size() const { return plan_.runs(); }
  std::size_t index_of(std::size_t variant, std::size_t world, std::size_t seed) const {
    return (variant * plan_.worlds.size() + world) * plan_.seeds.size() + seed;
  }
  /// None if the bench has no such run.
  std::optional<std::size_t> index_of(const RunKey& key) const;
  RunKey key_of(std::size_t index) const;
  /// The world of a run, and the run's number in it: by variant, then seed.
  std::pair<std::size_t, std::size_t> in_world(std::size_t index) const;

 private:
  const BenchPlan& plan_;
  std::map<std::pair<std::string, std::string>, std::size_t> variants_;
  std::map<std::string, std::size_t> worlds_;
  std::map<std::uint64_t, std::size_t> seeds_;
};

/// `krishna_kalra [sense.range_m=2] in u-trap, seed 3`, for messages.
std::string run_text(const RunKey& key);

}  // namespace clew::bench

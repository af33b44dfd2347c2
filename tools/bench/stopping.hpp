// SPDX-License-Identifier: Apache-2.0
/// A bench that ends as soon as its shares are known well enough.
#pragma once

#include <cstddef>
#include <vector>

#include "bench/bench_results.hpp"
#include "bench/statistics.hpp"

namespace clew::bench {

/// The batches in which a bench is run that looks at its results in between: of several seeds, one
/// after the other in all worlds; of one seed, the first world of each family, then the second.
class Batches {
 public:
  explicit Batches(const BenchPlan& plan);

  std::size_t count() const { return count_; }
  /// The plan of the first `number` batches, with the configuration of all.
  BenchPlan first(std::size_t number) const;
  /// How many batches are done at the next look: a tenth more each time, so that looks stay cheap.
  static std::size_t next_look(std::size_t done) { return done + 1 + done / 10; }

 private:
  const BenchPlan& plan_;
  std::vector<std::size_t> batch_of_world_;  ///< from 0; only if batches go by worlds
  std::size_t count_ = 0;
};

/// What is known of a variant's share of successes while runs are still coming in.
struct SequentialShare {
  std::size_t successes = 0;
  std::size_t trials = 0;
  Interval interval;  ///< anytime_interval

  double width() const { return interval.high - interval.low; }
};

/// The share of a variant's samples of which success is known.
SequentialShare sequential_share(const BenchResults& results, std::size_t variant);

/// The width of the variant of which least is known.
double widest(const BenchResults& results);

}  // namespace clew::bench

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "bench/bench_plan.hpp"
#include "bench/run_result.hpp"

namespace clew::bench {

/// All results of a bench, in its order: by variant, then world, then seed.
struct BenchResults {
  const BenchPlan* plan = nullptr;
  std::vector<RunResult> runs;

  /// The runs of a variant, in the order of worlds and seeds.
  std::vector<const RunResult*> of_variant(std::size_t variant) const;
  /// Those of them that count: of runs in one world with one hash, which are equal to the byte, the
  /// first. Without noise every seed gives the same run, and a copy is no sample of its own.
  std::vector<const RunResult*> samples_of(std::size_t variant) const;

  /// Whether there are several seeds, and none made a difference to a variant in any world: nothing
  /// random is on.
  bool ignores_seeds(std::size_t variant) const;
};

/// What a reader must know of the numbers, in sentences: runs that are copies, graphs that seeds do
/// not touch, worlds of which nobody knows whether they can be solved.
std::vector<std::string> remarks_on(const BenchResults& results);

}  // namespace clew::bench

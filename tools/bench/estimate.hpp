// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "bench/bench_plan.hpp"

namespace clew::bench {

/// What a bench will cost, from a sample of its runs.
struct Estimate {
  std::size_t sampled = 0;   ///< runs; 0 if it was interrupted
  double spent_s = 0.0;      ///< on the sample
  double run_s = 0.0;        ///< mean of a run
  double longest_s = 0.0;    ///< of those sampled
  double survey_s = 0.0;     ///< mean of what is done for a world before its first run
  double error_share = 0.0;  ///< standard error of run_s over run_s
};

/// Runs a sample that is spread over variants, worlds and seeds, always the same one: at most 32
/// runs, and no further one after `most_s` seconds.
core::Result<Estimate> estimate_cost(const BenchPlan& plan, const runtime::ConfigPath& configs,
                                     const std::vector<runtime::StageInfo>& stages, double most_s);

/// Seconds of one core for a whole bench of which each world is surveyed `surveys` times in all.
double total_s(const BenchPlan& plan, const Estimate& estimate, std::size_t surveys);

}  // namespace clew::bench

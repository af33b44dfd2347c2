// SPDX-License-Identifier: Apache-2.0
/// Comparisons in the same worlds with the same seeds. Pairs of runs that equal each other to the
/// byte count once.
#pragma once

#include "bench/bench_results.hpp"
#include "bench/summary.hpp"

namespace clew::bench {

/// Each variant against the one with the first value of the last `--vary`, all else equal; without
/// `--vary`, against the first variant. Empty with a single variant.
Table paired_table(const BenchResults& results);

/// Each graph against the first one, with the same values of everything that is varied. Empty if
/// nothing is varied, when it would be paired_table(), or with a single graph.
Table paired_graphs_table(const BenchResults& results);

}  // namespace clew::bench

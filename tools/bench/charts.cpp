// SPDX-License-Identifier: Apache-2.0
#include "bench/summary.hpp"

namespace clew::bench {

std::vector<Chart> charts_of(const BenchResults& results) {
  Chart success{"Success",
                "Share of runs with success, with 95 % intervals (Wilson).",
                "share",
                Interval{0.0, 1.0},
                {}};
  Chart path{"Path over shortest path",
             "Of runs that reached the target: median, with its 95 % interval (order statistics) "
             "where there are six runs or more.",
             "ratio",
             std::nullopt,
             {}};
  for (std::size_t i = 0; i < results.plan->variants.size(); ++i) {
    const std::string label = results.plan->variants[i].label();
    std::size_t trials = 0;
    std::size_t successes = 0;
    std::vector<double> ratios;
    for (const RunResult* run : results.samples_of(i)) {
      trials += run->success ? 1 : 0;
      successes += run->succeeded() ? 1 : 0;
      if (const auto ratio = run->path_ratio()) ratios.push_back(*ratio);
    }
    const CellRuns runs{i, {}, {}};
    if (trials > 0) {
      const double share = static_cast<double>(successes) / static_cast<double>(trials);
      success.points.push_back({label, share, wilson_interval(successes, trials), runs});
    }
    if (!ratios.empty()) {
      path.points.push_back({label, quantile(ratios, 0.5), quantile_interval(ratios, 0.5), runs});
    }
  }
  std::vector<Chart> charts;
  for (Chart& chart : std::vector<Chart>{success, path}) {
    if (!chart.points.empty()) charts.push_back(std::move(chart));
  }
  return charts;
}

}  // namespace clew::bench

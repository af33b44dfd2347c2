// SPDX-License-Identifier: Apache-2.0
/// What a clock measured of a run stands apart from its results, so that these are the same bytes
/// whoever makes them.
#pragma once

#include <functional>
#include <string>

#include "core/result.hpp"

namespace clew::bench {

/// A run's line, taken apart.
struct TimedLine {
  std::string result;  ///< without `start_s`, `wall_s` and `ticks_per_s`
  std::string timing;  ///< the run's `graph`, `variant`, `world` and `seed`, and these three
};

/// Takes a line of WorldBench::run apart.
core::Result<TimedLine> take_timing(const std::string& line);

/// Calls `visit` with each run of two files in one order, results and timing, as one line again.
/// The three are null where there is no timing of a run.
core::Result<void> visit_timed(const std::string& results_path, const std::string& timing_path,
                               const std::function<void(const std::string& line)>& visit);

}  // namespace clew::bench

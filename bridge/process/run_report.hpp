// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "core/hash128.hpp"
#include "process/run_tally.hpp"

namespace clew::bridge {

/// How a run went, in whatever layout.
struct RunReport {
  RunTally tally;  ///< as far as the run came
  std::optional<core::Hash128> hash;
  std::uint32_t restarts = 0;
  std::uint64_t refused_samples = 0;
  double wall_s = 0.0;       ///< from start to end
  double ticks_per_s = 0.0;  ///< from the first tick to the last
  std::string aborted;       ///< why the run ended without an outcome; empty if it has one
  int interrupted_by = 0;    ///< the signal that ended the run, if one did
};

/// Called now and then while a run goes on.
using ProgressDisplay = std::function<void(const RunTally&, double ticks_per_s)>;

}  // namespace clew::bridge

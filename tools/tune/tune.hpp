// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/statistics.hpp"
#include "tune/tune_space.hpp"

namespace clew::tune {

/// What a run that did not succeed costs, and the most that one costs that did.
inline constexpr double kFailureCost = 10.0;

/// What a run costs: its path over the shortest one if it succeeded (1 where no shortest path is
/// known, or where it was right to give up), else kFailureCost.
double cost_of(bool success, const std::optional<double>& path_ratio);

struct TuneOptions {
  std::size_t evaluations = 60;  ///< settings that are tried, at least; generations are whole
  std::uint64_t seed = 1;
  std::size_t jobs = 1;   ///< worker processes; changes no result
  std::string directory;  ///< for results; those that are there are gone on from
  bool restart = false;   ///< drop them
  /// What else the results depend on, such as the program.
  std::map<std::string, std::string> configuration;
  /// Called after each run, `best` the least cost so far. May be null.
  std::function<void(std::size_t runs, std::optional<double> best)> progress;
};

/// How settings did in some worlds.
struct Score {
  std::size_t runs = 0;
  std::size_t successes = 0;
  double cost = 0.0;  ///< the mean
};

struct Tuned {
  int interrupted_by = 0;  ///< a signal; then the rest is empty
  std::size_t evaluations = 0;
  std::vector<std::string> settings;  ///< the best, as --set takes them
  Score default_tuning;
  Score best_tuning;
  // In worlds that were not tuned in.
  Score default_validation;
  Score best_validation;
  std::size_t only_default = 0;  ///< runs in which only the graph's own settings succeeded
  std::size_t only_best = 0;
  /// The median of the difference in cost, best less default, with its interval at 95 %.
  double median_gain = 0.0;
  std::optional<bench::Interval> gain_interval;
};

/// Searches the ranges for settings of the least mean cost by CMA-ES, then runs them and the
/// graph's own in worlds that were not tuned in. The result is the best setting that was tried. A
/// search that is interrupted goes on from its results, run by run, and ends as it would have.
core::Result<Tuned> tune(const TuneSpace& space, const hunt::Workshop& workshop,
                         const TuneOptions& options);

}  // namespace clew::tune

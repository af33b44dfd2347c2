// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "insides/decisions.hpp"

namespace clew::bench {

/// What identifies a run of a bench.
struct RunKey {
  std::string graph;
  std::string variant;  ///< Variant::text
  std::string world;
  std::uint64_t seed = 0;

  bool operator<(const RunKey& other) const;
};

/// A choice of a component of a stage.
struct CoveredChoice {
  std::string stage;
  insides::Choice choice;
};

/// What the challenge of BARN gives a run.
struct BarnScore {
  bool arrived = false;  ///< in time
  double optimal_time_s = 0.0;
  double score = 0.0;
  double score_2022 = 0.0;  ///< by the rules of that year
};

/// What a report needs of a run's line.
struct RunResult {
  RunKey key;
  std::string family;
  std::string outcome;
  /// None where nobody knows whether `unreachable` is true.
  std::optional<bool> success;
  std::optional<bool> solvable;
  std::uint64_t ticks = 0;
  double sim_time_s = 0.0;
  double path_length_m = 0.0;
  std::optional<double> shortest_path_m;
  std::uint32_t collisions = 0;
  std::uint32_t hit_by = 0;
  std::uint32_t safety_stops = 0;
  std::string hash;
  std::optional<BarnScore> barn;  ///< in its worlds

  /// How hard the world is for this robot and sensor.
  struct Severity {
    std::optional<double> deepest_ranges;  ///< of its traps; 0: it has none; none: no way out
    std::uint32_t nested_pockets = 0;
    std::optional<double> backtrack_ranges;  ///< that no way avoids; none: there is no way
    double bug1_bound_m = 0.0;
    double bug2_bound_m = 0.0;
  };
  /// None where something moves for ever.
  std::optional<Severity> severity;

  /// None without a truth about traps.
  std::optional<std::uint32_t> captures;
  bool held_at_end = false;
  struct Detector {
    std::string rule;
    bool shadow = false;
    std::uint32_t alarms = 0;
    std::uint32_t false_alarms = 0;
    std::uint32_t noticed = 0;
    std::vector<double> delays_s;
    std::vector<double> delays_m;
  };
  std::vector<Detector> detectors;
  std::vector<CoveredChoice> coverage;  ///< of a bench that counts what decided

  bool reached() const { return outcome == "reached"; }
  bool succeeded() const { return success.value_or(false); }
  /// Path over shortest path; none where either is missing or the target was not reached.
  std::optional<double> path_ratio() const;
};

/// Reads which run a line of results or of timing is of.
core::Result<RunKey> read_run_key(const std::string& line);

/// Reads a line of results; refused is one that is not what WorldBench::run writes.
core::Result<RunResult> read_run_result(const std::string& line);

}  // namespace clew::bench

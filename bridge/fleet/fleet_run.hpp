// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/hash128.hpp"
#include "core/result.hpp"
#include "fleet/fleet_plan.hpp"
#include "run/run_statistics.hpp"
#include "runtime/run_plan.hpp"

namespace clew::fleet {

/// How one robot fared.
struct RobotReport {
  std::string name;
  bridge::RunStatistics statistics;
  core::Hash128 hash;
  std::string recording;  ///< the file; empty: none
  std::string failure;    ///< why there is none
};

/// How a fleet fared.
struct FleetReport {
  std::vector<RobotReport> robots;  ///< in the order of their indices
  std::uint64_t ticks = 0;          ///< the greatest of its robots'
  double sim_time_s = 0.0;          ///< the greatest of its robots'
  /// Over all robots: a line `name hexadecimal-digits` each.
  core::Hash128 hash;
  /// The least distance between two bodies at the end of a tick; infinite with one robot.
  double least_gap_m = std::numeric_limits<double>::infinity();
  std::uint64_t contacts = 0;  ///< pairs and ticks at which two bodies overlapped
  double wall_s = 0.0;
  std::string aborted;  ///< why it ended early; empty if it did not
  int interrupted_by = 0;

  bool all_reached() const;
};

/// A robot that is to run by itself, among the others as they moved.
struct RobotAlone {
  std::string name;
  runtime::RunPlan plan;
  std::string recording;  ///< the file; empty: none
};

/// What became of robots that ran by themselves, in their order.
struct AloneResults {
  std::vector<core::Result<core::Hash128>> hashes;
  int interrupted_by = 0;
};

struct FleetOptions {
  unsigned threads = 1;
  std::string record;  ///< a folder for a recording a robot; empty: none
  bool force = false;  ///< whether recordings may be overwritten
  /// Runs each robot again, by itself, in another layout, and makes the recordings; may be empty:
  /// then that is done here, and only for recordings.
  std::function<AloneResults(const std::vector<RobotAlone>&)> again;
  /// Asked between two ticks: the signal that is to end the run, or 0.
  std::function<int()> interrupted = [] { return 0; };
  std::function<void(std::uint64_t tick, std::size_t ended)> display;  ///< may be empty
};

/// The recording of a robot in a folder.
std::string recording_of(const std::string& folder, const RobotEntry& robot);

/// Runs all robots of a fleet in one world. In each tick, every robot has the others where they
/// were at the end of the tick before: so neither the order nor the threads matter.
///
/// A recording is made afterwards, by running each robot by itself among the others as they moved:
/// it is of a run that the others' ways are a part of, and replays without them. Its hash must be
/// the robot's in the fleet; so must that of a robot that runs `again`.
///
/// Refused, before it runs: more than kMostRecordedPlaces to be recorded or run again, a folder
/// that cannot be made, and recordings that exist, without `force`.
core::Result<FleetReport> run_fleet(const FleetPlan& plan, const FleetOptions& options);

}  // namespace clew::fleet

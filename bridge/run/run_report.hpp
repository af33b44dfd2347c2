// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/hash128.hpp"
#include "run/run_statistics.hpp"

namespace clew::bridge {

/// How the recording of a run went.
struct RecordingAccount {
  std::string failure;              ///< why it was not finished; empty if it was
  std::vector<std::string> losses;  ///< what it lacks, a phrase each
  std::uint64_t lost_samples = 0;
  bool nothing = false;  ///< a black box that nothing made write: there is no file
};

template <typename V>
void visit_fields(V& v, RecordingAccount& a) {
  v(a.failure, a.losses, a.lost_samples, a.nothing);
}

/// How a run went, in whatever layout.
struct RunReport {
  RunStatistics statistics;  ///< as far as the run came
  std::optional<core::Hash128> hash;
  std::uint32_t restarts = 0;
  std::uint64_t refused_samples = 0;
  double wall_s = 0.0;                        ///< from start to end
  std::optional<double> start_s;              ///< of processes: until the first tick was done
  double ticks_per_s = 0.0;                   ///< from the first tick to the last
  std::optional<RecordingAccount> recording;  ///< none: it was not recorded
  std::string aborted;        ///< why the run ended without an outcome; empty if it has one
  bool goal_changed = false;  ///< while it went on: the world's shortest path is another's
  bool secured = false;       ///< DDS Security protected what was on the wire
  int interrupted_by = 0;     ///< the signal that ended the run, if one did
};

/// What is wrong with a recording, as the end of the sentence `clew: `; empty if nothing is.
std::string complaint(const RecordingAccount& account);

/// Called now and then while a run goes on.
using ProgressDisplay = std::function<void(const RunStatistics&, double ticks_per_s)>;

}  // namespace clew::bridge

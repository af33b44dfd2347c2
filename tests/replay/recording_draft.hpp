// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "recording/run_description.hpp"
#include "recording/run_recording.hpp"

namespace clew::replay_test {

/// A recording taken apart, to be changed and written again, also as no recorder would.
struct RecordingDraft {
  struct Sample {
    domain::Topic topic = domain::Topic::kCommand;
    std::uint64_t tick = 0;
    std::uint64_t sequence = 0;
    std::string cdr;
  };
  bridge::RunDescription description;
  std::vector<Sample> samples;
  bool finished = true;  ///< else it has no end, as after a crash
  std::string aborted;   ///< why the run has no outcome, if it has none

  static RecordingDraft read(const std::string& path);
  /// With the end that a recorder would write: the hash is that of the samples.
  void write(const std::string& path) const;

  Sample& sample(domain::Topic topic, std::uint64_t tick);
  /// Leaves the samples of a topic from `first_tick` to `last_tick` out.
  void drop(domain::Topic topic, std::uint64_t first_tick, std::uint64_t last_tick);
};

}  // namespace clew::replay_test

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "recording/run_recording.hpp"
#include "replay/sample_comparison.hpp"

namespace clew::bridge {

/// How the samples of one topic compare.
struct TopicDiff {
  std::uint64_t samples_a = 0;
  std::uint64_t samples_b = 0;
  std::uint64_t equal = 0;
  std::uint64_t different = 0;
  std::uint64_t only_a = 0;
  std::uint64_t only_b = 0;
};

/// A text or number that a run was made of and that is not the same in both recordings.
struct ConfigurationDifference {
  std::string what;  ///< `seed`, `tick_s`, `version clew`, or a file's name
  std::string a;     ///< the value; of a file, the first line that differs; empty: has none
  std::string b;
};

struct RecordingDiff {
  /// In canonical order: tick, topic. Of the topics that both recordings have, so that it tells
  /// where behaviour parts; of the others only if those are equal.
  std::optional<SampleDifference> first;
  std::map<domain::Topic, bool> topics_of_one;  ///< topics of one graph only; whether it is a's
  std::map<domain::Topic, TopicDiff> topics;
  std::vector<ConfigurationDifference> configuration;  ///< counts for nothing

  bool identical() const { return !first.has_value(); }
};

/// Compares the samples of two recordings by tick and topic. Numbers in them that are at most
/// `tolerance` apart count as equal. Refused: message types of another version, changed bytes, and
/// samples that are not in canonical order.
core::Result<RecordingDiff> diff_recordings(const RunRecording& a, const RunRecording& b,
                                            double tolerance = 0.0);

}  // namespace clew::bridge

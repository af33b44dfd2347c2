// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/result.hpp"
#include "recording/run_recording.hpp"
#include "runtime/stage.hpp"

namespace clew::exports {

struct Rosbag2Options {
  std::string directory;
  bool force = false;
  std::string node_namespace;  ///< as of `clew bridge ros2`
};

/// Writes a recording as a bag that rosbag2 plays: the topics that `clew bridge ros2` would have
/// published, at simulated times. Maps, markers and diagnostics come once a simulated second.
/// Refused: a directory that exists, unless `force`.
core::Result<void> export_rosbag2(const bridge::RunRecording& recording,
                                  const Rosbag2Options& options,
                                  const std::vector<runtime::StageInfo>& stages);

}  // namespace clew::exports

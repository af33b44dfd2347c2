// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/result.hpp"
#include "recording/run_recording.hpp"

namespace clew::exports {

/// Writes a table a topic, `DIRECTORY/scan.csv`: a line a sample with its tick, its sequence, and a
/// column a field; lists have a column an item. Refused: a directory that exists, unless `force`.
core::Result<void> export_csv(const bridge::RunRecording& recording, const std::string& directory,
                              bool force);

}  // namespace clew::exports

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/result.hpp"
#include "recording/run_recording.hpp"

namespace clew::bridge {

/// Writes a recording's topics, and beside them the channels of foxglove_channels(), into an MCAP
/// file. Refused: a file that exists, unless `overwrite`, and what a gateway could not show.
core::Result<void> export_foxglove(const RunRecording& recording, const std::string& path,
                                   bool overwrite);

}  // namespace clew::bridge

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "clew/run_options.hpp"
#include "core/result.hpp"
#include "recording/run_description.hpp"

namespace clew::tools {

/// A file of a recording that is split holds at least so much, beside what each begins with.
inline constexpr std::uint64_t kLeastSplit = 1000;

/// Which of the options on the recording go together.
core::Result<void> check_recording_options(const RunOptions& options);

/// How `options` want the recording that `description` describes: which topics are in it, how it is
/// packed and when it goes on in another file. Refused: a topic that the run does not have.
core::Result<void> choose_recording(const RunOptions& options, bridge::RunDescription& description);

}  // namespace clew::tools

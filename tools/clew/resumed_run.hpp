// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "clew/run_options.hpp"
#include "recorder/recording_sink.hpp"
#include "replay/resumption.hpp"
#include "runtime/run_plan.hpp"

namespace clew::tools {

/// A run that goes on where its recording was cut off, and where it is recorded on.
struct ResumedRun {
  runtime::RunPlan plan;
  bridge::RecordingOrder recording;
  bridge::Resumption resumption;
  std::string file;  ///< where it is
};

/// Reads the recording that `options.resume` names, or its temporary name if only that is there.
/// Refused: options that the recording decides, one that is whole, and what bridge::resume refuses.
core::Result<ResumedRun> resume_run(const RunOptions& options);

/// Takes the recording in `file` over, which becomes `becomes`: it grows on in its place, or in a
/// copy that `options.record` names.
core::Result<void> claim_resumed(const RunOptions& options, const std::string& file,
                                 const std::string& becomes);

}  // namespace clew::tools

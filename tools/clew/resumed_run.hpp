// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "clew/commands.hpp"
#include "process/recording_sink.hpp"
#include "replay/resumption.hpp"
#include "runtime/run_plan.hpp"

namespace clew::tools {

/// A run that goes on where its recording was cut off, and where it is recorded on.
struct ResumedRun {
  runtime::RunPlan plan;
  bridge::RecordingOrder recording;
  bridge::Resumption resumption;
};

/// Reads the recording that `options.resume` names, or its temporary name if only that is there,
/// and takes it over: it grows on in its place, or in a copy that `options.record` names. Refused:
/// options that the recording decides, one that is whole, and what bridge::resume refuses; the file
/// is then left as it is.
core::Result<ResumedRun> resume_run(const RunOptions& options);

}  // namespace clew::tools

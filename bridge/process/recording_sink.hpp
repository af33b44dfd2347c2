// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "core/result.hpp"
#include "process/supervisor.hpp"
#include "recording/run_recorder.hpp"
#include "runtime/run_plan.hpp"

namespace clew::bridge {

/// Writes the samples of a run to a file.
class RecordingSink : public SampleSink {
 public:
  /// Refused: a file that exists, unless `overwrite`, and one that cannot be written.
  static core::Result<std::unique_ptr<RecordingSink>> create(const runtime::RunPlan& plan,
                                                             const std::string& path,
                                                             bool overwrite);

  core::Result<void> add(const SpooledSample& sample) override {
    return recorder_.add(sample.topic, sample.tick, sample.sequence, sample.cdr);
  }
  std::uint64_t complete_ticks() const override { return recorder_.complete_ticks(); }
  /// Finishes the file; nothing may follow.
  core::Result<void> close() { return recorder_.finish(); }

 private:
  explicit RecordingSink(RunRecorder recorder) : recorder_(std::move(recorder)) {}

  RunRecorder recorder_;
};

}  // namespace clew::bridge

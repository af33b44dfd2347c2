// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "core/result.hpp"
#include "process/run_report.hpp"
#include "process/sample_sink.hpp"
#include "recording/run_recorder.hpp"
#include "runtime/run_plan.hpp"

namespace clew::bridge {

/// Where a run is recorded, and what its recording says of it.
struct RecordingOrder {
  std::string path;
  RunDescription description;
};

template <typename V>
void visit_fields(V& v, RecordingOrder& o) {
  v(o.path, o.description);
}

/// What the recording of a run of this plan says of it.
RunDescription describe_run(const runtime::RunPlan& plan);

/// Writes the samples of a run to a file.
class RecordingSink : public SampleSink {
 public:
  /// Refused: a file that exists, unless `overwrite`, and one that cannot be written.
  static core::Result<std::unique_ptr<RecordingSink>> create(const runtime::RunPlan& plan,
                                                             const std::string& path,
                                                             bool overwrite);
  /// Goes on with a file that is reserved, or was left by a recorder of the same run: see
  /// RunRecorder::go_on.
  static core::Result<std::unique_ptr<RecordingSink>> go_on(const RecordingOrder& order,
                                                            std::uint64_t least_ticks = 0);

  core::Result<void> add(const SpooledSample& sample) override {
    return recorder_.add(sample.topic, sample.tick, sample.sequence, sample.cdr);
  }
  RunRecorder& recorder() { return recorder_; }

  /// Finishes the file, which gets its name or, `sealed` only, keeps the temporary one, and says
  /// how the recording went. Nothing may follow.
  RecordingAccount close(bool sealed = false);

 private:
  explicit RecordingSink(RunRecorder recorder) : recorder_(std::move(recorder)) {}

  RunRecorder recorder_;
};

}  // namespace clew::bridge

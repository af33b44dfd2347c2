// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/result.hpp"
#include "line/frames.hpp"
#include "recording/run_recorder.hpp"
#include "run/run_report.hpp"
#include "run/sample_sink.hpp"
#include "runtime/run_plan.hpp"

namespace clew::bridge {

/// Where a run is recorded, and what its recording says of it.
struct RecordingOrder {
  std::string path;
  RunDescription description;
  /// Above 0: a black box, which keeps so much simulated time and writes when something happens.
  double keep_last_s = 0.0;
  /// Whether files of the final names may be overwritten.
  bool overwrite = true;
};

template <typename V>
void visit_fields(V& v, RecordingOrder& o) {
  v(o.path, o.description, o.keep_last_s, o.overwrite);
}

/// What the recording of a run of this plan says of it.
RunDescription describe_run(const runtime::RunPlan& plan);

/// What components have to send for a recording, or for somebody who watches.
Spooling spooling_for(const std::optional<RecordingOrder>& order, bool is_watched);

/// How a run ended.
struct RunEnding {
  std::string aborted;  ///< why it has no outcome; empty if it has one
  /// The recording's file keeps its temporary name: giving it its own is someone else's.
  bool sealed = false;
  std::optional<core::Hash128> run_hash = {};  ///< of all its topics; none: it was not hashed
};

/// A recording in the making.
class RunSink : public SampleSink {
 public:
  /// Leaves in the file what would be lost with this process, as far as that can be.
  virtual core::Result<void> write_ahead() = 0;
  virtual Kept kept() const = 0;
  /// Finishes the file and says how the recording went. Nothing may follow.
  virtual RecordingAccount close(const RunEnding& ending) = 0;
};

/// Writes the samples of a run to a file.
class RecordingSink : public RunSink {
 public:
  /// Refused: a file that exists, unless `overwrite`, and one that cannot be written.
  static core::Result<std::unique_ptr<RecordingSink>> create(const RunDescription& description,
                                                             const std::string& path,
                                                             bool overwrite);
  /// The same with what describe_run says.
  static core::Result<std::unique_ptr<RecordingSink>> create(const runtime::RunPlan& plan,
                                                             const std::string& path,
                                                             bool overwrite);
  /// As open_sink; of a black box, from what made it write on.
  static core::Result<std::unique_ptr<RecordingSink>> go_on(const RecordingOrder& order,
                                                            std::uint64_t least_ticks = 0);

  core::Result<void> add(const SampleView& sample) override {
    return recorder_.add(sample.topic, sample.tick, sample.sequence, sample.cdr);
  }
  void add_intervention(const domain::Intervention& intervention) override {
    recorder_.add_intervention(intervention);
  }
  void add_incident(const domain::Incident& incident) override { recorder_.add_incident(incident); }
  core::Result<void> write_ahead() override { return recorder_.write_ahead(); }
  Kept kept() const override { return {recorder_.durable_ticks(), recorder_.durable_ticks()}; }
  RecordingAccount close(const RunEnding& ending) override;

 private:
  explicit RecordingSink(RunRecorder recorder) : recorder_(std::move(recorder)) {}

  RunRecorder recorder_;
};

}  // namespace clew::bridge

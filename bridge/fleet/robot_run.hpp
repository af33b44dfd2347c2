// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "core/hash128.hpp"
#include "core/result.hpp"
#include "run/run_statistics.hpp"
#include "run/sample_account.hpp"
#include "run/sample_sink.hpp"
#include "runtime/composed_executor.hpp"
#include "runtime/run_plan.hpp"
#include "wire/codec.hpp"

namespace clew::fleet {

/// The run of one robot, tick by tick: its components in one thread.
class RobotRun final : private runtime::SampleObserver {
 public:
  /// `recording` may be null.
  static core::Result<std::unique_ptr<RobotRun>> create(const runtime::RunPlan& plan,
                                                        bridge::SampleSink* recording);
  RobotRun(const RobotRun&) = delete;
  RobotRun& operator=(const RobotRun&) = delete;

  /// One tick; nothing once the run has ended.
  void step();
  /// Whether it has an outcome, or its recording has failed.
  bool has_ended() const;
  std::uint64_t next_tick() const { return executor_.next_tick(); }
  const bridge::RunStatistics& statistics() const { return account_.statistics(); }
  /// Of all samples so far: once the run has an outcome, that of the run.
  core::Hash128 hash() const;
  /// Why its recording was given up; empty if it was not.
  const std::string& failure() const { return failure_; }

 private:
  RobotRun(std::vector<runtime::Node> nodes, bridge::SampleSink* recording)
      : recording_(recording), executor_(std::move(nodes), this) {}
  void on_output(runtime::Topic topic, const domain::Messages& messages) override;

  bridge::Codecs codecs_;
  bridge::SampleAccount account_{true, false};
  bridge::SampleSink* recording_;
  std::string failure_;
  runtime::ComposedExecutor executor_;
};

}  // namespace clew::fleet

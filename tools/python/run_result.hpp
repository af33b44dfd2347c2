// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "python/module.hpp"
#include "recorder/recording_sink.hpp"
#include "run/composed_run.hpp"
#include "wire/codec.hpp"

namespace clew::python {

/// How a run went, and where the robot was.
struct RunResult {
  std::string outcome;
  std::uint64_t ticks = 0;
  double sim_time_s = 0.0;
  double path_length_m = 0.0;
  std::optional<double> shortest_path_m;
  std::uint32_t collisions = 0;
  double ticks_per_s = 0.0;
  std::optional<std::string> hash;
  std::vector<double> poses;  ///< x, y and heading of each tick
};

/// Notes the robot's true poses, and passes all samples on to a recording, if there is one.
class PathSink : public bridge::SampleSink {
 public:
  PathSink(bridge::SampleSink* recording, std::vector<double>& poses)
      : recording_(recording), poses_(poses) {}
  core::Result<void> add(const bridge::SampleView& sample) override {
    if (sample.topic == domain::Topic::kState) {
      CLEW_RETURN_IF_ERROR(bridge::decode(sample.cdr, &state_, bridge::Values::kAny));
      const core::Pose2& pose = state_.pose_world_robot;
      poses_.insert(poses_.end(), {pose.x_m, pose.y_m, pose.heading_rad});
    }
    if (recording_ == nullptr) return {};
    return recording_->add(sample);
  }

 private:
  bridge::SampleSink* recording_;
  std::vector<double>& poses_;
  domain::State state_;
};

/// Runs a plan, from `start` if given, without the interpreter's lock. Raises KeyboardInterrupt if
/// the user ends it, and InputError if the recording fails.
RunResult run_to_end(const runtime::RunPlan& plan, std::optional<bridge::ComposedStart> start,
                     std::unique_ptr<bridge::RecordingSink> file, bool hash);

}  // namespace clew::python

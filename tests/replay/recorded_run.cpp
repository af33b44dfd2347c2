// SPDX-License-Identifier: Apache-2.0
#include "recorded_run.hpp"

#include <gtest/gtest.h>

#include "recorder/recording_sink.hpp"
#include "replay/recorded_plan.hpp"
#include "run/composed_run.hpp"
#include "stages/all.hpp"
#include "tests/source_path.hpp"

namespace clew::replay_test {

const runtime::ConfigPath& shipped_configs() {
  static const runtime::ConfigPath path({tests::source_path("configs")});
  return path;
}

runtime::RunPlan plan_of(const std::string& graph, const runtime::GraphOverrides& overrides) {
  auto plan = runtime::prepare_run(graph, overrides, shipped_configs(), stages::all());
  EXPECT_TRUE(plan.ok()) << plan.error().text();
  return std::move(plan).value();
}

runtime::GraphOverrides changes(std::vector<std::string> with, std::vector<std::string> set,
                                std::uint64_t max_ticks) {
  runtime::GraphOverrides overrides;
  overrides.with = std::move(with);
  overrides.set = std::move(set);
  overrides.max_ticks = max_ticks;
  return overrides;
}

runtime::GraphOverrides in_world(const std::string& world, std::uint64_t max_ticks) {
  runtime::GraphOverrides overrides;
  overrides.world = world;
  overrides.max_ticks = max_ticks;
  return overrides;
}

void record_run(const runtime::RunPlan& plan, const std::string& path) {
  auto sink = bridge::RecordingSink::create(plan, path, false);
  ASSERT_TRUE(sink.ok()) << sink.error().text();
  const auto report = bridge::run_composed(plan, {}, sink->get(), {});
  ASSERT_TRUE(report.ok()) << report.error().text();
  ASSERT_EQ(report->aborted, "");
  ASSERT_EQ((*sink)->close({}).failure, "");
}

bridge::RunRecording open_recording(const std::string& path) {
  auto recording = bridge::RunRecording::open(path);
  EXPECT_TRUE(recording.ok()) << recording.error().text();
  return std::move(recording).value();
}

runtime::RunPlan replay_plan(const bridge::RunRecording& recording,
                             const runtime::GraphOverrides& overrides) {
  auto plan = bridge::changed_plan(recording, overrides, shipped_configs(), stages::all());
  EXPECT_TRUE(plan.ok()) << plan.error().text();
  return std::move(plan).value();
}

}  // namespace clew::replay_test

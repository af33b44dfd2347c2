// SPDX-License-Identifier: Apache-2.0
/// Runs a graph in this process, records it, and replays the recording:
///     consumer CONFIGS GRAPH RECORDING
/// prints the run's hash, and how many stages did again what is recorded.
#include <cstdio>
#include <memory>

#include "recorder/recording_sink.hpp"
#include "replay/component_replay.hpp"
#include "replay/recorded_plan.hpp"
#include "run/composed_run.hpp"
#include "runtime/run_plan.hpp"
#include "stages/all.hpp"

using namespace clew;

namespace {

int fail(const core::Error& error) {
  std::fprintf(stderr, "consumer: %s\n", error.text().c_str());
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  const runtime::ConfigPath configs({argv[1]});
  const auto plan = runtime::prepare_run(argv[2], {}, configs, stages::all());
  if (!plan.ok()) return fail(plan.error());
  auto sink = bridge::RecordingSink::create(bridge::describe_run(*plan), argv[3], true);
  if (!sink.ok()) return fail(sink.error());
  const auto report = bridge::run_composed(*plan, {}, sink->get(), nullptr);
  if (!report.ok()) return fail(report.error());
  (*sink)->close({});

  const auto recording = bridge::RunRecording::open(argv[3]);
  if (!recording.ok()) return fail(recording.error());
  const auto recorded = bridge::recorded_plan(*recording, stages::all());
  if (!recorded.ok()) return fail(recorded.error());
  int identical = 0;
  for (const auto& stage : recorded->graph.stages) {
    const auto replayed = bridge::replay_component(*recording, *recorded, stage.info->name);
    if (!replayed.ok()) return fail(replayed.error());
    identical += replayed->identical() ? 1 : 0;
  }
  std::printf("%s %d\n", report->hash->hex().c_str(), identical);
  return 0;
}

// SPDX-License-Identifier: Apache-2.0
/// Runs shipped graphs in shipped worlds composed, as tools/hashes has the command do it, and
/// replays recordings.
///   composed-run CONFIGS run GRAPH WORLD TICKS [RECORDING]    prints ticks and hash
///   composed-run CONFIGS replay RECORDING...                  prints what differs; status 1 if so
#include "run/composed_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "recorder/recording_sink.hpp"
#include "replay/component_replay.hpp"
#include "replay/recorded_plan.hpp"
#include "stages/all.hpp"

namespace clew::composed_test {
namespace {

using bridge::RecordingSink;
using bridge::RunRecording;

int fail(const core::Error& error) {
  fmt::print(stderr, "composed-run: {}\n", error.text());
  return 2;
}

int run(const std::string& configs, const std::vector<std::string>& words) {
  runtime::GraphOverrides overrides;
  overrides.world = words[1];
  overrides.max_ticks = std::strtoull(words[2].c_str(), nullptr, 10);
  const auto plan =
      runtime::prepare_run(words[0], overrides, runtime::ConfigPath({configs}), stages::all());
  if (!plan.ok()) return fail(plan.error());
  std::unique_ptr<RecordingSink> recording;
  if (words.size() > 3) {
    auto sink = RecordingSink::create(*plan, words[3], true);
    if (!sink.ok()) return fail(sink.error());
    recording = *std::move(sink);
  }
  const auto report = bridge::run_composed(*plan, {}, recording.get(), {});
  if (!report.ok()) return fail(report.error());
  if (!report->aborted.empty()) return fail({report->aborted});
  if (recording) {
    if (const auto closed = recording->close({}); !closed.failure.empty()) {
      return fail({closed.failure});
    }
  }
  fmt::print("{} {}\n", report->statistics.truth->tick, report->hash->hex());
  return 0;
}

int replay(const std::string& path) {
  const auto recording = RunRecording::open(path);
  if (!recording.ok()) return fail(recording.error());
  const auto plan = bridge::recorded_plan(*recording, stages::all());
  if (!plan.ok()) return fail(plan.error());
  bool same = true;
  for (const auto& stage : plan->graph.stages) {
    const auto report = bridge::replay_component(*recording, *plan, stage.info->name, {});
    if (!report.ok()) return fail(report.error());
    const bool whole = report->ticks == recording->end()->ticks;
    if (report->identical() && whole) continue;
    same = false;
    fmt::print("{}: {} of {} ticks of {} differ; compared: {}\n", path, report->different_ticks,
               recording->end()->ticks, stage.info->name, report->ticks);
  }
  return same ? 0 : 1;
}

int main_of(const std::vector<std::string>& words) {
  if (words.size() >= 5 && words.size() <= 6 && words[1] == "run") {
    return run(words[0], {words.begin() + 2, words.end()});
  }
  if (words.size() < 3 || words[1] != "replay") {
    return fail({"usage: composed-run CONFIGS run GRAPH WORLD TICKS [RECORDING] | replay FILE..."});
  }
  int worst = 0;
  for (std::size_t i = 2; i < words.size(); ++i) worst = std::max(worst, replay(words[i]));
  return worst;
}

}  // namespace
}  // namespace clew::composed_test

int main(int count, char** words) {
  return clew::composed_test::main_of({words + 1, words + count});
}

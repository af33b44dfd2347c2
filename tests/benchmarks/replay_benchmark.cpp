// SPDX-License-Identifier: Apache-2.0
/// How fast recordings are fed back and compared. The recording is one of 20,000 ticks of the whole
/// system of Krishna & Kalra in a box without a way out.

#include <benchmark/benchmark.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "process/composed_run.hpp"
#include "process/recording_sink.hpp"
#include "replay/component_replay.hpp"
#include "replay/recorded_plan.hpp"
#include "replay/recording_diff.hpp"
#include "stages/all.hpp"

namespace clew::bridge {
namespace {

constexpr std::uint64_t kTicks = 20000;

/// Made once, when the first benchmark asks for it; removed at the end.
class LongRecording {
 public:
  LongRecording() {
    std::string name = (std::filesystem::temp_directory_path() / "clew-replay-XXXXXX").string();
    CLEW_CHECK(::mkdtemp(name.data()) != nullptr, name);
    directory_ = name;
    const runtime::ConfigPath configs({CLEW_SOURCE_DIR "/configs"});
    runtime::GraphOverrides overrides;
    overrides.world = "unsolvable-box";
    overrides.max_ticks = kTicks;
    overrides.with = {"recover.detector=none"};  // that never gives up
    const auto plan = runtime::prepare_run("krishna_kalra", overrides, configs, stages::all());
    auto sink = RecordingSink::create(*plan, path(), false);
    CLEW_CHECK(run_composed(*plan, {}, sink->get(), {}).ok() && (*sink)->close().failure.empty(),
               path());
  }
  ~LongRecording() { std::filesystem::remove_all(directory_); }
  LongRecording(const LongRecording&) = delete;
  LongRecording& operator=(const LongRecording&) = delete;

  std::string path() const { return (directory_ / "run.mcap").string(); }
  static const LongRecording& instance() {
    static const LongRecording recording;
    return recording;
  }

 private:
  std::filesystem::path directory_;
};

/// One component, fed with what was recorded and compared; items are ticks.
void replay(benchmark::State& state, const std::string& stage) {
  const auto recording = RunRecording::open(LongRecording::instance().path());
  const auto plan = recorded_plan(*recording, stages::all());
  for (auto _ : state) {
    const auto report = replay_component(*recording, *plan, stage);
    CLEW_CHECK(report.ok() && report->identical(), stage);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kTicks + 1));
}
BENCHMARK_CAPTURE(replay, drive, std::string("drive"))->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(replay, sense, std::string("sense"))->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(replay, classify, std::string("classify"))->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(replay, recover, std::string("recover"))->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(replay, control, std::string("control"))->Unit(benchmark::kMillisecond);

/// Two recordings of the same run; bytes are those of one of them.
void diff(benchmark::State& state) {
  const std::string path = LongRecording::instance().path();
  const auto a = RunRecording::open(path);
  const auto b = RunRecording::open(path);
  for (auto _ : state) {
    const auto found = diff_recordings(*a, *b);
    CLEW_CHECK(found.ok() && found->identical(), path);
  }
  state.SetBytesProcessed(state.iterations() *
                          static_cast<std::int64_t>(std::filesystem::file_size(path)));
}
BENCHMARK(diff)->Unit(benchmark::kMillisecond);

/// All samples read and hashed, as `clew info` does.
void survey(benchmark::State& state) {
  const std::string path = LongRecording::instance().path();
  const auto recording = RunRecording::open(path);
  for (auto _ : state) CLEW_CHECK(recording->survey().ok(), path);
  state.SetBytesProcessed(state.iterations() *
                          static_cast<std::int64_t>(std::filesystem::file_size(path)));
}
BENCHMARK(survey)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace clew::bridge

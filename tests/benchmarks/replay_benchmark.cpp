// SPDX-License-Identifier: Apache-2.0
/// How fast recordings are written, read, fed back and compared. The recording is one of 20,000
/// ticks of the whole system of Krishna & Kalra in a box without a way out. MB/s are of samples,
/// without what a file adds; the plain write and read beside them are of the same bytes in the same
/// pieces.

#include <benchmark/benchmark.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "recorder/recording_sink.hpp"
#include "replay/component_replay.hpp"
#include "replay/recorded_plan.hpp"
#include "replay/recording_diff.hpp"
#include "run/composed_run.hpp"
#include "stages/all.hpp"
#include "tests/source_path.hpp"

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
    const runtime::ConfigPath configs({tests::source_path("configs")});
    runtime::GraphOverrides overrides;
    overrides.world = "unsolvable-box";
    overrides.max_ticks = kTicks;
    overrides.with = {"recover.detector=none"};  // that never gives up
    const auto plan = runtime::prepare_run("krishna_kalra", overrides, configs, stages::all());
    auto sink = RecordingSink::create(*plan, path(), false);
    CLEW_CHECK(run_composed(*plan, {}, sink->get(), {}).ok() && (*sink)->close({}).failure.empty(),
               path());
  }
  ~LongRecording() { std::filesystem::remove_all(directory_); }
  LongRecording(const LongRecording&) = delete;
  LongRecording& operator=(const LongRecording&) = delete;

  std::string path() const { return (directory_ / "run.mcap").string(); }
  std::string scratch() const { return (directory_ / "scratch").string(); }
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

/// All samples of the recording, in memory.
struct Samples {
  struct Sample {
    domain::Topic topic = domain::Topic::kCommand;
    std::uint64_t tick = 0;
    std::uint64_t sequence = 0;
    std::string cdr;
  };

  Samples() {
    const auto recording = RunRecording::open(LongRecording::instance().path());
    description = recording->description();
    SampleStream stream = recording->samples();
    while (true) {
      const auto sample = stream.next();
      CLEW_CHECK(sample.ok(), recording->path());
      if (!*sample) break;
      all.push_back(
          {(*sample)->topic, (*sample)->tick, (*sample)->sequence, std::string((*sample)->cdr)});
      bytes += static_cast<std::int64_t>((*sample)->cdr.size());
    }
  }
  static const Samples& instance() {
    static const Samples samples;
    return samples;
  }

  RunDescription description;
  std::vector<Sample> all;
  std::int64_t bytes = 0;
};

// What the recorder collects before it writes: a second of samples.
constexpr std::size_t kPiece = 8192;

void write_plain(benchmark::State& state) {
  const Samples& samples = Samples::instance();
  const std::string path = LongRecording::instance().scratch();
  for (auto _ : state) {
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    std::string piece;
    for (const auto& sample : samples.all) {
      piece += sample.cdr;
      if (piece.size() < kPiece) continue;
      file.write(piece.data(), static_cast<std::streamsize>(piece.size()));
      piece.clear();
    }
    file.write(piece.data(), static_cast<std::streamsize>(piece.size()));
    CLEW_CHECK(file.good(), path);
  }
  state.SetBytesProcessed(state.iterations() * samples.bytes);
}
BENCHMARK(write_plain)->Unit(benchmark::kMillisecond);

void write_recording(benchmark::State& state, const std::string& compression) {
  const Samples& samples = Samples::instance();
  const std::string path = LongRecording::instance().scratch();
  RunDescription description = samples.description;
  description.compression = *mcap::compression_from_name(compression);
  for (auto _ : state) {
    auto recorder = RunRecorder::create(path, description, true);
    CLEW_CHECK(recorder.ok(), path);
    for (const auto& s : samples.all) {
      CLEW_CHECK(recorder->add(s.topic, s.tick, s.sequence, s.cdr).ok(), path);
    }
    CLEW_CHECK(recorder->finish().ok(), path);
  }
  state.SetBytesProcessed(state.iterations() * samples.bytes);
}
BENCHMARK_CAPTURE(write_recording, none, std::string())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(write_recording, lz4, std::string("lz4"))->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(write_recording, zstd, std::string("zstd"))->Unit(benchmark::kMillisecond);

void read_plain(benchmark::State& state) {
  const std::string path = LongRecording::instance().path();
  std::string bytes(std::filesystem::file_size(path), '\0');
  for (auto _ : state) {
    std::ifstream file(path, std::ios::binary);
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    CLEW_CHECK(file.good(), path);
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes.size()));
}
BENCHMARK(read_plain)->Unit(benchmark::kMillisecond);

/// Every sample, its chunk's CRC checked.
void read_recording(benchmark::State& state) {
  const std::string path = LongRecording::instance().path();
  for (auto _ : state) {
    const auto recording = RunRecording::open(path);
    SampleStream stream = recording->samples();
    for (auto sample = stream.next(); sample.ok() && *sample; sample = stream.next()) {
      benchmark::DoNotOptimize((*sample)->cdr.data());
    }
  }
  state.SetBytesProcessed(state.iterations() * Samples::instance().bytes);
}
BENCHMARK(read_recording)->Unit(benchmark::kMillisecond);

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

// SPDX-License-Identifier: Apache-2.0
/// What a message costs on its way: encoding, decoding, and one hop between two processes.
#include <benchmark/benchmark.h>
#include <sched.h>

#include <condition_variable>
#include <mutex>
#include <string>

#include "echo_process.hpp"
#include "recording_listeners.hpp"
#include "test_domain.hpp"
#include "wire/codec.hpp"

namespace clew::bridge {
namespace {

template <typename Message>
void encode(benchmark::State& state) {
  Codec<Message> codec;
  Message message;
  for (auto _ : state) {
    ++message.stamp.tick;
    benchmark::DoNotOptimize(codec.encode(message).data());
  }
}

template <typename Message>
void decode(benchmark::State& state) {
  Codec<Message> codec;
  const std::string bytes(codec.encode(Message{}));
  Message message;
  for (auto _ : state) {
    if (!codec.decode(bytes, message).ok()) state.SkipWithError("refused");
  }
}

BENCHMARK_TEMPLATE(encode, domain::Scan);
BENCHMARK_TEMPLATE(encode, domain::Landmark);
BENCHMARK_TEMPLATE(encode, domain::Guidance);
BENCHMARK_TEMPLATE(encode, domain::Command);
BENCHMARK_TEMPLATE(decode, domain::Scan);
BENCHMARK_TEMPLATE(decode, domain::Landmark);
BENCHMARK_TEMPLATE(decode, domain::Guidance);
BENCHMARK_TEMPLATE(decode, domain::Command);

/// Sends a sample back and forth, in the thread that delivers it.
class PingPong : public SampleListener {
 public:
  void start(SampleWriter& writer, int rounds, std::string_view cdr) {
    writer_ = &writer;
    left_ = rounds;
    writer.write(cdr);
  }
  /// False if no answer came, or a write would have had to wait: that would be no latency.
  bool wait() {
    std::unique_lock lock(mutex_);
    const bool done = ended_.wait_for(lock, kPatience, [&] { return is_done_; });
    is_done_ = false;
    return done && left_ == 0;
  }
  void on_sample(std::string_view cdr, const RemoteEndpoint*) override {
    if (--left_ > 0 && writer_->write(cdr) == WriteStatus::kTaken) return;
    const std::lock_guard lock(mutex_);
    is_done_ = true;
    ended_.notify_one();
  }

 private:
  SampleWriter* writer_ = nullptr;
  int left_ = 0;
  std::mutex mutex_;
  std::condition_variable ended_;
  bool is_done_ = false;
};

/// While it lives, this process may use the first core only.
class OnFirstCore {
 public:
  OnFirstCore() {
    sched_getaffinity(0, sizeof all_cores_, &all_cores_);
    cpu_set_t first_core;
    CPU_ZERO(&first_core);
    CPU_SET(0, &first_core);
    sched_setaffinity(0, sizeof first_core, &first_core);
  }
  ~OnFirstCore() { sched_setaffinity(0, sizeof all_cores_, &all_cores_); }
  OnFirstCore(const OnFirstCore&) = delete;
  OnFirstCore& operator=(const OnFirstCore&) = delete;

 private:
  cpu_set_t all_cores_{};
};

/// One hop: half of a round trip of 200 bytes between this process and one on `core`, or any if it
/// is -1. Arguments: the vendor of either side.
void hop(benchmark::State& state, int core) {
  constexpr int kRounds = 2000;
  TestDomain domain;
  DiscoveryRecord discovery;
  PingPong game;
  const auto vendor = static_cast<Vendor>(state.range(0));
  const auto participant = create_participant(vendor, {domain.number(), "ping", 1.5}, discovery);
  const auto writer =
      (*participant)->create_writer({"question", "clew::msg::Test", "", kEchoDepth});
  const auto reader =
      (*participant)->create_reader({"answer", "clew::msg::Test", "", kEchoDepth}, game);
  {
    EchoProcess echo(static_cast<Vendor>(state.range(1)), domain.number(), core);
    std::string cdr("\x00\x01\x00\x00", 4);
    cdr.resize(200);
    bool is_playing = discovery.wait_for_matches(2);
    for (auto _ : state) {
      game.start(**writer, kRounds, cdr);
      is_playing = is_playing && game.wait();
      if (!is_playing) state.SkipWithError("the echo is silent, or a history is full");
    }
  }
  state.SetLabel(std::string(vendor_name(vendor)) + " to " +
                 std::string(vendor_name(static_cast<Vendor>(state.range(1)))));
  state.counters["one_way"] = benchmark::Counter(
      2.0 * kRounds, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// Each side on a core of its own, since placement matters more than anything else.
void one_way(benchmark::State& state) {
  const OnFirstCore first;
  hop(state, 1);
}
BENCHMARK(one_way)->ArgsProduct({{0, 1}, {0, 1}})->UseRealTime()->Unit(benchmark::kMillisecond);

/// As the system places them.
void hop_unpinned(benchmark::State& state) { hop(state, -1); }
BENCHMARK(hop_unpinned)->Args({0, 0})->Args({1, 1})->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace clew::bridge

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "domain/topics.hpp"
#include "run/step_times.hpp"

namespace clew::bridge {

/// How durations are spread. Their number, sum and greatest are exact; a quantile is that of its
/// bucket, at most 1/32 too short.
class Durations {
 public:
  void add(std::chrono::nanoseconds duration, std::uint64_t times = 1);
  std::uint64_t count() const { return count_; }
  double sum_us() const { return static_cast<double>(sum_ns_) * 1e-3; }
  double mean_us() const { return count_ == 0 ? 0.0 : sum_us() / static_cast<double>(count_); }
  double greatest_us() const { return static_cast<double>(greatest_ns_) * 1e-3; }
  /// The least duration that `share` of all do not exceed; 0 without any.
  double quantile_us(double share) const;

 private:
  static constexpr int kBitsOfOctave = 5;
  static constexpr std::size_t kOctave = std::size_t{1} << kBitsOfOctave;
  static std::size_t bucket_of(std::uint64_t ns);
  static std::uint64_t least_ns(std::size_t bucket);

  std::uint64_t count_ = 0;
  std::uint64_t sum_ns_ = 0;
  std::uint64_t greatest_ns_ = 0;
  std::array<std::uint64_t, 64 * kOctave> buckets_{};
};

/// Where the time and the allocations of a composed run go: into the steps of each component and
/// the parts that it tells of, into what is done with the samples (hash, recording), and into whole
/// ticks. Wall-clock time, which no result depends on.
class RunProfile {
 public:
  using Clock = std::chrono::steady_clock;

  /// A time, and how many allocations there have been until then.
  struct Moment {
    Clock::time_point at;
    std::uint64_t allocations = 0;
  };

  /// A component, and what it writes.
  struct Writer {
    std::string name;
    std::vector<domain::Topic> topics;
  };

  static constexpr std::size_t kMostSpans = 200000;

  /// In the order of their steps; each topic has one writer at most. The trace has `most_spans`.
  explicit RunProfile(const std::vector<Writer>& writers, std::size_t most_spans = kMostSpans);

  void begin_tick(std::uint64_t tick, const Moment& now);
  /// A part of the step of the component that writes next.
  void begin_part(std::string_view name, const Moment& now);
  void end_part(const Moment& now);
  /// A component has written to `topic`: what has passed since the last sample was its step.
  void begin_sample(domain::Topic topic, const Moment& now);
  /// The sample is hashed, and handed to whoever records it.
  void end_sample(const Moment& now);
  void end_tick(const Moment& now);

  /// Of a component; none has stepped, or none is called so: of none.
  StepTimes step_times(const std::string& name) const;
  /// A row each for components, their parts, samples and ticks: mean, median, 99th percentile,
  /// greatest, share, and allocations a tick.
  std::string table() const;
  /// The trace of the first ticks in Chrome's format, for chrome://tracing or Perfetto.
  std::string trace() const;

 private:
  struct Row {
    std::string name;
    std::size_t of;                       // the component's row; of others, the row itself
    Durations durations;                  // of its share of a tick
    std::chrono::nanoseconds in_tick{0};  // of the tick that has begun
    std::uint64_t allocations = 0;
  };
  /// A part that has begun, of a component that has written nothing yet.
  struct OpenPart {
    std::string name;
    Moment from;
    Moment until;
  };
  struct Span {
    std::uint32_t row = 0;
    std::uint64_t tick = 0;
    std::chrono::nanoseconds from{0};  // since the first tick began
    std::chrono::nanoseconds length{0};
  };

  std::size_t row_of(std::size_t component, const std::string& part);
  void spend(std::size_t row, const Moment& from, const Moment& until);
  std::string line(const Row& row) const;

  static constexpr std::size_t kSamples = 0;
  static constexpr std::size_t kTicks = 1;
  static constexpr std::size_t kComponents = 2;

  const std::size_t most_spans_;
  const std::size_t components_;
  std::vector<Row> rows_;                                  // samples, ticks, components, parts
  std::array<std::size_t, domain::kTopicCount> writer_{};  // row by topic
  std::vector<OpenPart> parts_;                            // of the step under way
  std::vector<Span> spans_;
  std::uint64_t tick_ = 0;
  std::uint64_t ticks_ = 0;
  Clock::time_point began_;
  Moment tick_began_;
  Moment last_;
};

}  // namespace clew::bridge

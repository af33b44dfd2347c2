// SPDX-License-Identifier: Apache-2.0
#include "run/run_profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace clew::bridge {
namespace {

using std::chrono::nanoseconds;

double us(nanoseconds duration) { return static_cast<double>(duration.count()) * 1e-3; }

}  // namespace

std::size_t Durations::bucket_of(std::uint64_t ns) {
  if (ns < kOctave) return static_cast<std::size_t>(ns);
  const int octave = 63 - __builtin_clzll(ns) - kBitsOfOctave;
  return static_cast<std::size_t>(octave) * kOctave + static_cast<std::size_t>(ns >> octave);
}

std::uint64_t Durations::least_ns(std::size_t bucket) {
  if (bucket < 2 * kOctave) return bucket;
  const std::size_t octave = bucket / kOctave - 1;
  return static_cast<std::uint64_t>(bucket - octave * kOctave) << octave;
}

void Durations::add(nanoseconds duration) {
  const auto ns = static_cast<std::uint64_t>(std::max<std::int64_t>(0, duration.count()));
  ++count_;
  sum_ns_ += ns;
  greatest_ns_ = std::max(greatest_ns_, ns);
  ++buckets_[bucket_of(ns)];
}

double Durations::quantile_us(double share) const {
  const auto wanted = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(count_)));
  std::uint64_t passed = 0;
  for (std::size_t bucket = 0; bucket < buckets_.size(); ++bucket) {
    passed += buckets_[bucket];
    if (passed > 0 && passed >= wanted) return static_cast<double>(least_ns(bucket)) * 1e-3;
  }
  return 0.0;
}

RunProfile::RunProfile(const std::vector<Writer>& writers, std::size_t most_spans)
    : most_spans_(most_spans) {
  for (const Writer& writer : writers) {
    for (const domain::Topic topic : writer.topics) {
      writer_[index_of(topic)] = rows_.size();
    }
    rows_.push_back({writer.name, {}});
  }
  rows_.push_back({"samples", {}});
  rows_.push_back({"tick", {}});
}

void RunProfile::begin_tick(std::uint64_t tick, Clock::time_point now) {
  if (ticks_ == 0) began_ = now;
  tick_ = tick;
  ++ticks_;
  tick_began_ = now;
  last_ = now;
  for (Row& row : rows_) row.in_tick = nanoseconds(0);
}

void RunProfile::begin_sample(domain::Topic topic, Clock::time_point now) {
  spend(writer_[index_of(topic)], now);
}

void RunProfile::end_sample(Clock::time_point now) { spend(rows_.size() - 2, now); }

void RunProfile::end_tick(Clock::time_point now) {
  last_ = tick_began_;
  spend(rows_.size() - 1, now);
  for (Row& row : rows_) row.durations.add(row.in_tick);
}

void RunProfile::spend(std::size_t row, Clock::time_point until) {
  const nanoseconds length = until - last_;
  rows_[row].in_tick += length;
  if (spans_.size() < most_spans_) {
    spans_.push_back({static_cast<std::uint32_t>(row), tick_, last_ - began_, length});
  }
  last_ = until;
}

StepTimes RunProfile::step_times(const std::string& name) const {
  for (const Row& row : rows_) {
    if (row.name != name) continue;
    return {row.durations.count(), row.durations.quantile_us(0.5), row.durations.quantile_us(0.99)};
  }
  return {};
}

std::string RunProfile::table() const {
  std::string text = fmt::format("{:<12} {:>10} {:>10} {:>10} {:>10} {:>7}\n", "us a tick", "mean",
                                 "p50", "p99", "max", "share");
  const double all_us = rows_.back().durations.sum_us();
  for (const Row& row : rows_) {
    const Durations& spent = row.durations;
    const double share = all_us > 0.0 ? 100.0 * spent.sum_us() / all_us : 0.0;
    text += fmt::format("{:<12} {:>10.2f} {:>10.2f} {:>10.2f} {:>10.2f} {:>6.1f}%\n", row.name,
                        spent.mean_us(), spent.quantile_us(0.5), spent.quantile_us(0.99),
                        spent.greatest_us(), share);
  }
  return text;
}

std::string RunProfile::trace() const {
  std::string text = "{\"displayTimeUnit\":\"ns\",\"traceEvents\":[";
  for (std::size_t i = 0; i < spans_.size(); ++i) {
    const Span& span = spans_[i];
    text += fmt::format(
        "{}\n{{\"name\":\"{}\",\"ph\":\"X\",\"pid\":1,\"tid\":1,\"ts\":{:.3f},\"dur\":{:.3f},"
        "\"args\":{{\"tick\":{}}}}}",
        i == 0 ? "" : ",", rows_[span.row].name, us(span.from), us(span.length), span.tick);
  }
  return text + "\n]}\n";
}

}  // namespace clew::bridge

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

void Durations::add(nanoseconds duration, std::uint64_t times) {
  const auto ns = static_cast<std::uint64_t>(std::max<std::int64_t>(0, duration.count()));
  count_ += times;
  sum_ns_ += times * ns;
  greatest_ns_ = std::max(greatest_ns_, ns);
  buckets_[bucket_of(ns)] += times;
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
    : most_spans_(most_spans), components_(writers.size()) {
  rows_.push_back({"samples", kSamples, {}});
  rows_.push_back({"tick", kTicks, {}});
  for (const Writer& writer : writers) {
    for (const domain::Topic topic : writer.topics) writer_[index_of(topic)] = rows_.size();
    rows_.push_back({writer.name, rows_.size(), {}});
  }
}

void RunProfile::begin_tick(std::uint64_t tick, const Moment& now) {
  if (ticks_ == 0) began_ = now.at;
  tick_ = tick;
  ++ticks_;
  tick_began_ = now;
  last_ = now;
  parts_.clear();
  for (Row& row : rows_) row.in_tick = nanoseconds(0);
}

void RunProfile::begin_part(std::string_view name, const Moment& now) {
  parts_.push_back({std::string(name), now, now});
}

void RunProfile::end_part(const Moment& now) { parts_.back().until = now; }

void RunProfile::begin_sample(domain::Topic topic, const Moment& now) {
  const std::size_t component = writer_[index_of(topic)];
  spend(component, last_, now);
  for (const OpenPart& part : parts_) spend(row_of(component, part.name), part.from, part.until);
  parts_.clear();
  last_ = now;
}

void RunProfile::end_sample(const Moment& now) {
  spend(kSamples, last_, now);
  last_ = now;
}

void RunProfile::end_tick(const Moment& now) {
  spend(kTicks, tick_began_, now);
  last_ = now;
  for (Row& row : rows_) row.durations.add(row.in_tick);
}

/// The row of a component's part. One that is new took no time in the ticks before.
std::size_t RunProfile::row_of(std::size_t component, const std::string& part) {
  for (std::size_t i = kComponents + components_; i < rows_.size(); ++i) {
    if (rows_[i].of == component && rows_[i].name == part) return i;
  }
  rows_.push_back({part, component, {}});
  rows_.back().durations.add(nanoseconds(0), ticks_ - 1);
  return rows_.size() - 1;
}

void RunProfile::spend(std::size_t row, const Moment& from, const Moment& until) {
  const nanoseconds length = until.at - from.at;
  rows_[row].in_tick += length;
  rows_[row].allocations += until.allocations - from.allocations;
  if (spans_.size() < most_spans_) {
    spans_.push_back({static_cast<std::uint32_t>(row), tick_, from.at - began_, length});
  }
}

StepTimes RunProfile::step_times(const std::string& name) const {
  for (std::size_t i = kComponents; i < kComponents + components_; ++i) {
    if (rows_[i].name != name) continue;
    const Durations& spent = rows_[i].durations;
    return {spent.count(), spent.quantile_us(0.5), spent.quantile_us(0.99)};
  }
  return {};
}

std::string RunProfile::table() const {
  std::string text = fmt::format("{:<20} {:>10} {:>10} {:>10} {:>10} {:>7} {:>11}\n", "us a tick",
                                 "mean", "p50", "p99", "max", "share", "allocations");
  for (std::size_t component = kComponents; component < kComponents + components_; ++component) {
    text += line(rows_[component]);
    for (std::size_t i = kComponents + components_; i < rows_.size(); ++i) {
      if (rows_[i].of == component) text += line(rows_[i]);
    }
  }
  return text + line(rows_[kSamples]) + line(rows_[kTicks]);
}

/// A line of the table; that of a part is set in.
std::string RunProfile::line(const Row& row) const {
  const Durations& spent = row.durations;
  const double all_us = rows_[kTicks].durations.sum_us();
  const double share = all_us > 0.0 ? 100.0 * spent.sum_us() / all_us : 0.0;
  const bool is_part = row.of != static_cast<std::size_t>(&row - rows_.data());
  const double allocations =
      ticks_ > 0 ? static_cast<double>(row.allocations) / static_cast<double>(ticks_) : 0.0;
  return fmt::format("{:<20} {:>10.2f} {:>10.2f} {:>10.2f} {:>10.2f} {:>6.1f}% {:>11.2f}\n",
                     (is_part ? "  " : "") + row.name, spent.mean_us(), spent.quantile_us(0.5),
                     spent.quantile_us(0.99), spent.greatest_us(), share, allocations);
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

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

namespace clew::bridge {

/// Mean, ends and standard deviation (of the whole, not of a sample) of some numbers.
struct Spread {
  std::size_t count = 0;
  double mean = 0.0;
  double min = 0.0;
  double max = 0.0;
  double stddev = 0.0;
};

/// The last numbers, at most `most`.
class NumberWindow {
 public:
  explicit NumberWindow(std::size_t most) : most_(most) {}

  void add(double number);
  /// None before the first number.
  std::optional<Spread> spread() const;

 private:
  std::size_t most_;
  std::deque<double> numbers_;
};

/// When the last samples of a topic arrived, and how large they were: `most` of them. A sample with
/// a sequence number tells how many were lost on the way, so the rate is the writer's.
class ArrivalWindow {
 public:
  explicit ArrivalWindow(std::size_t most) : most_(most) {}

  /// `sequence`: from 0, of its topic; none where samples have none. One that is not beyond the
  /// last one is of a writer that was set back.
  void add(double time_s, std::size_t bytes, std::optional<std::uint64_t> sequence);

  std::size_t count() const { return arrivals_.size(); }
  /// Samples a second, and bytes; none before there were two samples at different times.
  std::optional<double> rate_hz() const;
  std::optional<double> bytes_per_s() const;
  /// Of the times between two arrivals, in s.
  std::optional<Spread> intervals_s() const;
  std::optional<Spread> sizes_bytes() const;
  /// Samples that did not arrive, of all there ever were.
  std::uint64_t lost() const { return lost_; }

 private:
  struct Arrival {
    double time_s;
    std::size_t bytes;
    std::uint64_t lost_before;
  };
  double span_s() const;

  std::size_t most_;
  std::deque<Arrival> arrivals_;
  std::optional<std::uint64_t> last_sequence_;
  std::uint64_t lost_ = 0;
};

}  // namespace clew::bridge

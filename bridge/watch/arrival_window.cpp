// SPDX-License-Identifier: Apache-2.0
#include "watch/arrival_window.hpp"

#include <algorithm>
#include <cmath>

namespace clew::bridge {

void NumberWindow::add(double number) {
  if (numbers_.size() >= most_) numbers_.pop_front();
  numbers_.push_back(number);
}

std::optional<Spread> NumberWindow::spread() const {
  if (numbers_.empty()) return std::nullopt;
  Spread spread;
  spread.count = numbers_.size();
  const auto count = static_cast<double>(spread.count);
  for (const double number : numbers_) spread.mean += number / count;
  double variance = 0.0;
  for (const double number : numbers_) {
    variance += (number - spread.mean) * (number - spread.mean) / count;
  }
  spread.stddev = std::sqrt(variance);
  const auto [least, most] = std::minmax_element(numbers_.begin(), numbers_.end());
  spread.min = *least;
  spread.max = *most;
  return spread;
}

void ArrivalWindow::add(double time_s, std::size_t bytes, std::optional<std::uint64_t> sequence) {
  std::uint64_t lost = 0;
  if (sequence && last_sequence_ && *sequence > *last_sequence_) {
    lost = *sequence - *last_sequence_ - 1;
  }
  if (sequence) last_sequence_ = sequence;
  lost_ += lost;
  if (arrivals_.size() >= most_) arrivals_.pop_front();
  arrivals_.push_back({time_s, bytes, lost});
}

double ArrivalWindow::span_s() const {
  return arrivals_.size() < 2 ? 0.0 : arrivals_.back().time_s - arrivals_.front().time_s;
}

std::optional<double> ArrivalWindow::rate_hz() const {
  if (!(span_s() > 0.0)) return std::nullopt;
  double samples = 0.0;
  for (std::size_t i = 1; i < arrivals_.size(); ++i) {
    samples += 1.0 + static_cast<double>(arrivals_[i].lost_before);
  }
  return samples / span_s();
}

std::optional<double> ArrivalWindow::bytes_per_s() const {
  const auto sizes = sizes_bytes();
  const auto rate = rate_hz();
  if (!rate || !sizes) return std::nullopt;
  return *rate * sizes->mean;
}

std::optional<Spread> ArrivalWindow::intervals_s() const {
  NumberWindow intervals(most_);
  for (std::size_t i = 1; i < arrivals_.size(); ++i) {
    intervals.add(arrivals_[i].time_s - arrivals_[i - 1].time_s);
  }
  return intervals.spread();
}

std::optional<Spread> ArrivalWindow::sizes_bytes() const {
  NumberWindow sizes(most_);
  for (const Arrival& arrival : arrivals_) sizes.add(static_cast<double>(arrival.bytes));
  return sizes.spread();
}

}  // namespace clew::bridge

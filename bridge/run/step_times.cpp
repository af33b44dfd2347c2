// SPDX-License-Identifier: Apache-2.0
#include "run/step_times.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace clew::bridge {
namespace {

/// The element of rank `share` of `ns`, by nearest rank.
double quantile_us(std::vector<std::uint32_t>& ns, double share) {
  const auto rank = static_cast<std::size_t>(share * static_cast<double>(ns.size() - 1) + 0.5);
  const auto place = ns.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(ns.begin(), place, ns.end());
  return static_cast<double>(*place) * 1e-3;
}

}  // namespace

void RecentSteps::add(std::chrono::nanoseconds duration) {
  constexpr std::int64_t kLongest = std::numeric_limits<std::uint32_t>::max();
  const auto ns = std::clamp<std::int64_t>(duration.count(), 0, kLongest);
  const std::uint64_t count = count_.load(std::memory_order_relaxed);
  ns_[count % kMost].store(static_cast<std::uint32_t>(ns), std::memory_order_relaxed);
  count_.store(count + 1, std::memory_order_release);
}

StepTimes RecentSteps::times() const {
  const std::uint64_t count = count_.load(std::memory_order_acquire);
  if (count == 0) return {};
  std::vector<std::uint32_t> ns;
  for (std::size_t i = 0; i < std::min<std::uint64_t>(count, kMost); ++i) {
    ns.push_back(ns_[i].load(std::memory_order_relaxed));
  }
  return {ns.size(), quantile_us(ns, 0.5), quantile_us(ns, 0.99)};
}

}  // namespace clew::bridge

// SPDX-License-Identifier: Apache-2.0
#include "bench/statistics.hpp"

#include <algorithm>
#include <cmath>

#include "core/check.hpp"

namespace clew::bench {
namespace {

constexpr double kNormal975 = 1.959963984540054;  // the 97.5 % quantile of the normal distribution

/// The probability of at most `most` heads in `tosses` of a coin.
double coin_at_most(std::size_t most, std::size_t tosses) {
  const double n = static_cast<double>(tosses);
  double sum = 0.0;
  for (std::size_t k = 0; k <= most; ++k) {
    const double heads = static_cast<double>(k);
    const double log_ways =
        std::lgamma(n + 1.0) - std::lgamma(heads + 1.0) - std::lgamma(n - heads + 1.0);
    sum += std::exp(log_ways - n * std::log(2.0));
  }
  return std::min(sum, 1.0);
}

/// Of a falling or rising condition, the end of the side on which it holds.
template <typename Holds>
double bisect(double holds_at, double fails_at, const Holds& holds) {
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (holds_at + fails_at);
    (holds(middle) ? holds_at : fails_at) = middle;
  }
  return fails_at;
}

}  // namespace

Interval wilson_interval(std::size_t successes, std::size_t trials) {
  if (trials == 0) return {0.0, 1.0};
  const double n = static_cast<double>(trials);
  const double p = static_cast<double>(successes) / n;
  const double z2 = kNormal975 * kNormal975;
  const double middle = (p + z2 / (2.0 * n)) / (1.0 + z2 / n);
  const double half =
      kNormal975 / (1.0 + z2 / n) * std::sqrt(p * (1.0 - p) / n + z2 / (4.0 * n * n));
  // At the ends the formula gives 0 and 1 but for rounding.
  return {successes == 0 ? 0.0 : middle - half, successes == trials ? 1.0 : middle + half};
}

Interval anytime_interval(std::size_t successes, std::size_t trials) {
  if (trials == 0) return {0.0, 1.0};
  const double n = static_cast<double>(trials);
  const double s = static_cast<double>(successes);
  const double log_ways = std::lgamma(n + 1.0) - std::lgamma(s + 1.0) - std::lgamma(n - s + 1.0);
  const double least = std::log(0.05) - std::log(n + 1.0) - log_ways;
  const auto is_inside = [&](double p) {
    const double of_successes = successes == 0 ? 0.0 : s * std::log(p);
    const double of_failures = successes == trials ? 0.0 : (n - s) * std::log1p(-p);
    return of_successes + of_failures > least;
  };
  const double share = s / n;
  return {successes == 0 ? 0.0 : bisect(share, 0.0, is_inside),
          successes == trials ? 1.0 : bisect(share, 1.0, is_inside)};
}

double quantile(std::vector<double> values, double share) {
  CLEW_CHECK(!values.empty(), "a quantile of nothing");
  std::sort(values.begin(), values.end());
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

double mcnemar_p(std::size_t only_first, std::size_t only_second) {
  const std::size_t pairs = only_first + only_second;
  if (pairs == 0) return 1.0;
  return std::min(1.0, 2.0 * coin_at_most(std::min(only_first, only_second), pairs));
}

std::optional<Interval> median_interval(std::vector<double> values) {
  // The r-th least and r-th greatest value cover the median but for a chance of
  // 2 P(fewer than r heads in n tosses).
  std::size_t rank = 0;
  while (2 * (rank + 1) <= values.size() && 2.0 * coin_at_most(rank, values.size()) <= 0.05) ++rank;
  if (rank == 0) return std::nullopt;
  std::sort(values.begin(), values.end());
  return Interval{values[rank - 1], values[values.size() - rank]};
}

}  // namespace clew::bench

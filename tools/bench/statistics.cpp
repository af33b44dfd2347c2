// SPDX-License-Identifier: Apache-2.0
#include "bench/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/check.hpp"
#include "core/random.hpp"

namespace clew::bench {
namespace {

constexpr std::size_t kResamples = 1000;
constexpr std::size_t kFewestValues = 6;          // for an interval of the mean
constexpr double kNormal975 = 1.959963984540054;  // the 97.5 % quantile of the normal distribution

/// The probability of at most `most` heads in `tosses` of a coin that shows heads with this chance,
/// which is neither 0 nor 1.
double coin_at_most(std::size_t most, std::size_t tosses, double chance = 0.5) {
  const double n = static_cast<double>(tosses);
  double sum = 0.0;
  for (std::size_t k = 0; k <= std::min(most, tosses); ++k) {
    const double heads = static_cast<double>(k);
    const double log_ways =
        std::lgamma(n + 1.0) - std::lgamma(heads + 1.0) - std::lgamma(n - heads + 1.0);
    sum += std::exp(log_ways + heads * std::log(chance) + (n - heads) * std::log1p(-chance));
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

std::optional<Interval> quantile_interval(std::vector<double> values, double share) {
  // Each value is below the quantile like a coin with that share. The r-th least value is above it
  // if fewer than r are below, and the s-th least is below it if at least s are.
  constexpr double kTail = 0.025;
  const std::size_t n = values.size();
  std::size_t low = 0;
  while (low < n && coin_at_most(low, n, share) <= kTail) ++low;
  std::size_t high = low + 1;
  while (high <= n && 1.0 - coin_at_most(high - 1, n, share) > kTail) ++high;
  if (low == 0 || high > n) return std::nullopt;
  std::sort(values.begin(), values.end());
  return Interval{values[low - 1], values[high - 1]};
}

double mean(const std::vector<double>& values) {
  CLEW_CHECK(!values.empty(), "a mean of nothing");
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::optional<Interval> mean_interval(const std::vector<double>& values) {
  if (values.size() < kFewestValues) return std::nullopt;
  std::vector<double> means(kResamples);
  for (std::size_t i = 0; i < kResamples; ++i) {
    const core::Random random(core::RandomKey{1, 0, 0, i});
    double sum = 0.0;
    for (std::size_t k = 0; k < values.size(); ++k) {
      const double at = random.uniform(static_cast<std::uint32_t>(k));
      sum += values[static_cast<std::size_t>(at * static_cast<double>(values.size()))];
    }
    means[i] = sum / static_cast<double>(values.size());
  }
  return Interval{quantile(means, 0.025), quantile(means, 0.975)};
}

}  // namespace clew::bench

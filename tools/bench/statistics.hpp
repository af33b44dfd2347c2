// SPDX-License-Identifier: Apache-2.0
/// The statistics of a bench report. All intervals and tests are at 95 % and exact in small
/// numbers: a cell of a table holds a dozen runs.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace clew::bench {

struct Interval {
  double low = 0.0;
  double high = 0.0;
};

/// The 95 % interval of a probability after `successes` in `trials` (Wilson 1927; Brown, Cai &
/// DasGupta 2001 recommend it for small numbers). [0, 1] without trials.
Interval wilson_interval(std::size_t successes, std::size_t trials);

/// An interval of a probability after `successes` in `trials` that may be looked at after every
/// trial: with 95 % all of these intervals together hold the true probability, however often one
/// looks and whenever one stops. The probabilities p with
///   (n + 1) C(n, s) p^s (1 - p)^(n - s) > 0.05,
/// Robbins's confidence sequence with a uniform mixture (Robbins 1970, Statistical methods related
/// to the law of the iterated logarithm; Lai 1976, On confidence sequences), which holds by Ville's
/// inequality without an approximation. About twice as wide as Wilson's. [0, 1] without trials.
Interval anytime_interval(std::size_t successes, std::size_t trials);

/// The quantile `share` in [0, 1] of at least one value, linear between the two nearest (type 7 of
/// Hyndman & Fan 1996).
double quantile(std::vector<double> values, double share);

/// The two-sided p-value of McNemar's test in its exact form: under the hypothesis of no
/// difference, the pairs in which only one of the two succeeded fall to either side like a coin.
/// 1 without such pairs.
double mcnemar_p(std::size_t only_first, std::size_t only_second);

/// A distribution-free interval of the quantile `share` in (0, 1) that covers it with at least
/// 95 %, from order statistics (for the median the inversion of the sign test; Conover 1999,
/// section 3.2). None for fewer values than such an interval takes: 6 for the median.
std::optional<Interval> quantile_interval(std::vector<double> values, double share);

/// Of at least one value.
double mean(const std::vector<double>& values);

/// A 95 % interval of the mean: the percentiles of the means of 1000 resamples (Efron 1979). The
/// same values in the same order give the same interval. None for fewer than 6 values.
std::optional<Interval> mean_interval(const std::vector<double>& values);

}  // namespace clew::bench

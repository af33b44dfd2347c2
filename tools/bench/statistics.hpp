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

/// A distribution-free interval of the median that covers it with at least 95 %, from order
/// statistics (the inversion of the sign test; Conover 1999, section 3.2). None for fewer than 6
/// values, with which no such interval exists.
std::optional<Interval> median_interval(std::vector<double> values);

}  // namespace clew::bench

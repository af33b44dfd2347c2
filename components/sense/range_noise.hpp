// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/random.hpp"
#include "domain/messages.hpp"

namespace clew::sense {

struct RangeNoiseParameters {
  double stddev_m = 0.0;
  double outlier_ratio = 0.0;
  double drop_out_ratio = 0.0;
  double resolution_m = 0.0;
};

template <typename Visitor>
void visit_parameters(Visitor& visit, RangeNoiseParameters& p) {
  visit.number("noise_stddev_m", p.stddev_m, "m", {0.0, 1.0},
               "standard deviation of the normal error of a reading that returned");
  visit.number("outlier_ratio", p.outlier_ratio, "1", {0.0, 1.0},
               "share of readings that are replaced by a random distance within range");
  visit.number("drop_out_ratio", p.drop_out_ratio, "1", {0.0, 1.0},
               "share of readings that are lost and read as free space");
  visit.number("resolution_m", p.resolution_m, "m", {0.0, 1.0},
               "readings are rounded to multiples of it; 0 is off");
}

/// Spoils the true ranges of `scan` as every range sensor of the project does, in this order:
///
/// - a reading is lost (range_max_m) with probability drop_out_ratio, and else an outlier, uniform
///   in [range_min_m, range_max_m], with probability outlier_ratio; the two exclude each other;
/// - a return that is neither has a normal error; where nothing returned there is nothing to err;
/// - all are rounded to the resolution and clipped to [range_min_m, range_max_m].
///
/// Each reading has three random numbers of its own, drawn or not, so options do not shift each
/// other's numbers.
void add_range_noise(const RangeNoiseParameters& parameters, const core::Random& random,
                     domain::Scan& scan);

}  // namespace clew::sense

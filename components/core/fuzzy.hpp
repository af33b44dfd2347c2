// SPDX-License-Identifier: Apache-2.0
/// Fuzzy sets.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace clew::core {

/// Degree of membership in a fuzzy set that holds fully up to `full` and not at all from `none` on,
/// linear between; full < none.
inline double falling_membership(double x, double full, double none) {
  if (x <= full) return 1.0;
  if (x >= none) return 0.0;
  return (none - x) / (none - full);
}

/// Fuzzy sets over a line, triangles between neighbouring peaks: each set is full at its own peak
/// and gone at its neighbours', the outer two stay full beyond theirs. Degrees add up to 1.
struct FuzzyPartition {
  std::vector<double> peaks;  ///< one a set, rising

  /// Degree of membership of x in set i.
  double degree(std::size_t i, double x) const {
    if (x <= peaks[i]) {
      if (i == 0) return 1.0;
      return std::max(0.0, (x - peaks[i - 1]) / (peaks[i] - peaks[i - 1]));
    }
    if (i + 1 == peaks.size()) return 1.0;
    return std::max(0.0, (peaks[i + 1] - x) / (peaks[i + 1] - peaks[i]));
  }

  /// Whether the peaks rise, as they must.
  bool rises() const {
    return std::adjacent_find(peaks.begin(), peaks.end(),
                              [](double a, double b) { return a >= b; }) == peaks.end();
  }
};

}  // namespace clew::core

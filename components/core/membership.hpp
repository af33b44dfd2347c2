// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace clew::core {

/// Degree of membership in a fuzzy set that holds fully up to `full` and not at all from `none` on,
/// linear between; full < none.
inline double falling_membership(double x, double full, double none) {
  if (x <= full) return 1.0;
  if (x >= none) return 0.0;
  return (none - x) / (none - full);
}

}  // namespace clew::core

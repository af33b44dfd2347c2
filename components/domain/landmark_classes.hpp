// SPDX-License-Identifier: Apache-2.0
/// Landmarks as points: three spatial classes each.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace clew::domain {

/// The last of the spatial classes of Krishna & Kalra 2000, table I; the first is 0.
inline constexpr std::uint8_t kLastClass = 8;

/// The square of the Euclidean distance between two landmark vectors, in classes.
inline double squared_class_distance(const std::array<double, 3>& a,
                                     const std::array<double, 3>& b) {
  double squared = 0.0;
  for (std::size_t i = 0; i < 3; ++i) squared += (a[i] - b[i]) * (a[i] - b[i]);
  return squared;
}

}  // namespace clew::domain

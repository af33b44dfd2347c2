// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstring>

namespace clew::control {

/// Numbers that are worked on at once. Each lane is plain arithmetic in the order in which it is
/// written, so any processor gives the same bits.
using Lanes [[gnu::vector_size(2 * sizeof(double))]] = double;
inline constexpr std::size_t kLanes = 2;

inline Lanes load_lanes(const double* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof(lanes));
  return lanes;
}

inline void store_lanes(const Lanes& lanes, double* to) { std::memcpy(to, &lanes, sizeof(lanes)); }

}  // namespace clew::control

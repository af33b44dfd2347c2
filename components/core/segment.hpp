// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "core/geometry.hpp"

namespace clew::core {

/// Where on the line from `from` to `to` its nearest point to `point` is: 0 at `from`, 1 at `to`,
/// less and more beyond them; 0 if both are the same.
inline double fraction_along(const Vec2& from, const Vec2& to, const Vec2& point) {
  const Vec2 way = to - from;
  const double square = way.dot(way);
  return square > 0.0 ? (point - from).dot(way) / square : 0.0;
}

/// The point of the segment that is nearest to `point`.
inline Vec2 nearest_on_segment(const Vec2& from, const Vec2& to, const Vec2& point) {
  return from + std::clamp(fraction_along(from, to, point), 0.0, 1.0) * (to - from);
}

inline double distance_to_segment_m(const Vec2& from, const Vec2& to, const Vec2& point) {
  const double along = std::clamp(fraction_along(from, to, point), 0.0, 1.0);
  return length(point - from - along * (to - from));
}

}  // namespace clew::core

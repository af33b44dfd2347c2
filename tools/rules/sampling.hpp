// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/fuzzy.hpp"
#include "rules/rule_base.hpp"

namespace clew::rules {

/// Of a set's degrees, and of each side of a surface.
inline constexpr std::size_t kDegrees = 101;
inline constexpr std::size_t kCells = 41;

/// The value of step `i` of `count` along an axis.
inline double value_at(const Axis& axis, std::size_t i, std::size_t count) {
  return axis.low +
         (axis.high - axis.low) * static_cast<double>(i) / static_cast<double>(count - 1);
}

template <typename Degree>
FuzzySet sample_set(std::string name, const Axis& axis, const Degree& degree) {
  FuzzySet set{std::move(name), {}};
  for (std::size_t i = 0; i < kDegrees; ++i)
    set.degrees.push_back(degree(value_at(axis, i, kDegrees)));
  return set;
}

/// The sets of a partition, whose values are those of the axis times `scale`.
inline Variable sample_partition(const Axis& axis, const core::FuzzyPartition& partition,
                                 const std::vector<std::string>& names, double scale) {
  Variable variable{axis, {}};
  for (std::size_t set = 0; set < partition.peaks.size(); ++set) {
    variable.sets.push_back(
        sample_set(names[set], axis, [&](double x) { return partition.degree(set, scale * x); }));
  }
  return variable;
}

/// answer(across, up) over the surface's axes.
template <typename Answer>
Surface sample_surface(Surface surface, const Answer& answer) {
  surface.columns = kCells;
  for (std::size_t row = 0; row < kCells; ++row) {
    for (std::size_t column = 0; column < kCells; ++column) {
      surface.values.push_back(
          answer(value_at(surface.across, column, kCells), value_at(surface.up, row, kCells)));
    }
  }
  return surface;
}

}  // namespace clew::rules

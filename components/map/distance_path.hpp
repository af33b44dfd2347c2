// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "map/distance_field.hpp"
#include "map/path_search.hpp"

namespace clew::map {

/// The path of least cost over eight neighbours, from a field of distances that is kept from one
/// search to the next and repaired where costs have changed. What it finds is what a new one finds,
/// to the bit.
class DistancePath final : public PathSearch {
 public:
  const std::vector<Vec2>& find(const Costmap& costs, const Vec2& from, const Vec2& to,
                                double goal_radius_m) override;

 private:
  /// A field to the goals of one radius.
  struct Kept {
    double goal_radius_m = 0.0;
    DistanceField field;
  };

  // For the goals that a search asks for first, and those that it asks for if there is no path.
  std::array<Kept, 2> kept_;
  std::size_t last_ = 0;
  std::vector<Cell> goals_;
  std::vector<Vec2> way_;
};

}  // namespace clew::map

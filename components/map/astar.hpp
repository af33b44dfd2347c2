// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "map/path_search.hpp"

namespace clew::map {

/// A* (Hart, Nilsson & Raphael 1968) over eight neighbours, with the straight distance as estimate
/// and a binary heap. A step between two cells costs its length times the mean of their costs. Ties
/// go to the cell of the lesser index, so that equal grids give equal ways.
class AStar final : public PathSearch {
 public:
  const std::vector<Vec2>& find(const Costmap& costs, const Vec2& from, const Vec2& to,
                                double goal_radius_m) override;

 private:
  struct Open {
    float estimate_m = 0.0F;  // of the whole way
    std::uint32_t cell = 0;
  };
  /// The cell of the least estimate comes first, and among equals that of the least index.
  struct IsLater {
    bool operator()(const Open& a, const Open& b) const {
      return a.estimate_m != b.estimate_m ? a.estimate_m > b.estimate_m : a.cell > b.cell;
    }
  };
  struct Node {
    float cost_m = 0.0F;  // of the best way here so far
    std::uint32_t before = 0;
    std::uint32_t search = 0;  // in which the rest was written
    bool closed = false;
  };

  void begin(const Costmap& costs);
  bool is_better(std::uint32_t cell, float cost_m) const;
  void open(std::uint32_t cell, std::uint32_t before, float cost_m, float estimate_m);
  void trace(const Grid& grid, std::uint32_t last);

  std::uint32_t search_ = 0;
  std::vector<Node> nodes_;
  std::vector<Open> open_;
  std::vector<Vec2> way_;
};

}  // namespace clew::map

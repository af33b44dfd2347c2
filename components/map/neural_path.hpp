// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "map/bottleneck.hpp"
#include "map/neural_map.hpp"
#include "map/path_search.hpp"

namespace clew::map {

/// Steepest ascent on the neural map of the cells that are open, or, if these do not connect both
/// places, of the narrow and then the suspected ones besides, and at last of all that have any
/// room. A landscape knows no costs: so the level is chosen first, by a flood, and one landscape
/// evolved, in which all that is not open is dear. Were all cells of a level alike, the shortest
/// way would lead along walls, in what is believed to touch them.
class NeuralPath final : public PathSearch {
 public:
  explicit NeuralPath(NeuralMap landscape) : landscape_(std::move(landscape)) {}

  const std::vector<Vec2>& find(const Costmap& costs, const Vec2& from, const Vec2& to,
                                double goal_radius_m) override;

 private:
  void take_room(const Costmap& costs, const Cell& start);

  Bottleneck widest_;
  NeuralMap landscape_;
  std::vector<Clearance> room_;
  std::vector<std::uint8_t> passable_;
  std::vector<Cell> targets_;
  std::vector<Cell> cells_;
  std::vector<Vec2> way_;
};

}  // namespace clew::map

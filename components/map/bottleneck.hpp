// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "map/costmap.hpp"

namespace clew::map {

/// Tells how much room there is at the narrowest place of the way that has the most there: of
/// cells that are linked to their eight neighbours, which level of clearance connects two places.
/// The ways themselves are not looked at: rows of cells are flooded 64 at a time, so that it costs
/// far less than a search. Holds nothing but memory to work in.
class Bottleneck {
 public:
  /// The highest level at which `start` is connected to one of the targets by cells of that level
  /// and above, all included; kNone if no cells that have any room connect them. All cells lie
  /// within the grid.
  ///
  /// room: by Grid::index.
  Clearance between(const Grid& grid, const std::vector<Clearance>& room, const Cell& start,
                    const std::vector<Cell>& targets);

 private:
  void begin(const Grid& grid);
  void open(const std::vector<Clearance>& room, Clearance least);
  void flood();
  bool flood_row(std::int32_t row, std::int32_t before);

  std::uint64_t& word(std::vector<std::uint64_t>& bits, const Cell& cell) const;

  Grid grid_;
  std::size_t words_ = 0;  // of a row, in which bit i is column i; with an empty one on each side
  std::vector<std::uint64_t> open_;
  std::vector<std::uint64_t> flooded_;
};

}  // namespace clew::map

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/geometry.hpp"
#include "world_import/world_draft.hpp"

namespace clew::world_import {

enum class CellState : std::uint8_t { kFree, kOccupied, kUnknown };

/// Cells of somebody else's map, row-major from the lower left, in a frame that may be turned.
struct CellMap {
  std::size_t columns = 0;
  std::size_t rows = 0;
  double cell_m = 0.05;
  Pose2 origin;  ///< where the lower left corner lies, and how the columns' axis is turned
  std::vector<CellState> cells;

  CellState at(std::size_t column, std::size_t row) const { return cells[row * columns + column]; }
  /// A place given in cells from the corner, in the frame of the world.
  Vec2 place(double column, double row) const;
};

/// The map as a world: blocked cells become as few rectangles as a simple search finds, and what
/// lies beside a map that is turned is blocked. Unknown cells are blocked if `unknown_is_blocked`.
WorldDraft world_of(const CellMap& map, bool unknown_is_blocked);

}  // namespace clew::world_import

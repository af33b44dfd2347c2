// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "core/result.hpp"
#include "world_import/cell_world.hpp"

namespace clew::world_import {

/// Reads a grid of the MovingAI benchmarks (movingai.com/benchmarks/formats.html): `.`, `G` and `S`
/// are free, `@`, `O`, `T` and `W` blocked.
core::Result<CellMap> read_moving_ai_map(const std::string& path, double cell_m);

/// A line of a scenario file.
struct Scenario {
  std::string map;  ///< as the file names it
  std::size_t start_column = 0;
  std::size_t start_row = 0;  ///< from the top
  std::size_t target_column = 0;
  std::size_t target_row = 0;
  double optimal_length = 0.0;  ///< in cells, over eight neighbours
};

/// Reads line `number`, from 1, of a scenario file; the last one if none is given.
core::Result<Scenario> read_scenario(const std::string& path, std::optional<std::size_t> number);

}  // namespace clew::world_import

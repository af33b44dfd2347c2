// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/result.hpp"

namespace clew::world_import {

/// A picture's brightness and opacity, 0 to 1, rows from the top.
struct GreyPicture {
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::vector<float> brightness;
  std::vector<float> opacity;
};

/// Reads a whole file.
core::Result<std::string> read_file(const std::string& path);

/// Reads a PGM (P2, P5) or PNG picture; colours become the mean of red, green and blue, as in
/// map_server. Refused: other formats, broken files, and more than map::kMaxMapCells pixels.
core::Result<GreyPicture> read_picture(const std::string& path);

}  // namespace clew::world_import

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"

namespace clew::map {

/// The largest map that is read.
inline constexpr std::size_t kMaxMapCells = std::size_t{1} << 24;

/// A grey picture, rows from the top.
struct Picture {
  std::int32_t columns = 0;
  std::int32_t rows = 0;
  double white = 255.0;  ///< the greatest grey there can be
  std::vector<std::uint16_t> greys;
};

/// Reads a PGM picture of kind P2 or P5 (netpbm.sourceforge.net/doc/pgm.html), comments and ends of
/// lines of CR and LF in its head included. `file` is named in errors. A picture that goes on
/// behind its last pixel is refused: its head does not say what it holds.
core::Result<Picture> read_pgm(std::string_view bytes, const std::string& file);

}  // namespace clew::map

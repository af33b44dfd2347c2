// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace clew::map {

/// What a block weighs that costs 1.
inline constexpr std::uint32_t kWeightOfOne = 4;

/// A step from a block to a neighbour, and which cells of the two touch. Cell 1 of a block lies
/// right of cell 0, and 2 and 3 above them.
struct BlockStep {
  std::int32_t columns;
  std::int32_t rows;
  std::uint32_t length;
  std::uint8_t own;
  std::uint8_t other;
};
inline constexpr std::array<BlockStep, 8> kBlockSteps = {{{1, 0, 12, 0b1010, 0b0101},
                                                          {1, 1, 17, 0b1000, 0b0001},
                                                          {0, 1, 12, 0b1100, 0b0011},
                                                          {-1, 1, 17, 0b0100, 0b0010},
                                                          {-1, 0, 12, 0b0101, 0b1010},
                                                          {-1, -1, 17, 0b0001, 0b1000},
                                                          {0, -1, 12, 0b0011, 0b1100},
                                                          {1, -1, 17, 0b0010, 0b0100}}};
inline constexpr std::uint8_t kAllMembers = 0b1111;

}  // namespace clew::map

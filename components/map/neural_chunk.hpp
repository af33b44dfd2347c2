// SPDX-License-Identifier: Apache-2.0
/// How NeuralMap holds activations and works on them, for its own two sources.
#pragma once

#include <cstddef>
#include <cstdint>

#include "map/neural_map.hpp"

namespace clew::map {

inline constexpr std::int32_t kChunk = 32;

// Of the mantissas: 2^-340 and its inverse. Products of two of them, and values 32 cells on at the
// least gain, are normal doubles yet.
inline constexpr int kBandBits = 340;
inline constexpr double kBand = 0x1p-340;
inline constexpr double kBandInverse = 0x1p340;

/// The cells of a chunk: indices in the padded arrays.
struct NeuralMap::Span {
  std::size_t begin;
  std::size_t above;  // of the cell at begin, in the row of lower number
  std::size_t below;
  std::size_t length;
  std::int32_t row;
  std::int32_t chunk;
};

/// What a chunk reads, as plain doubles: the cell to the left is at -1.
struct NeuralMap::Rows {
  const double* above;
  const double* own;
  const double* below;
};

}  // namespace clew::map

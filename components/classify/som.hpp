// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "classify/class_sequence.hpp"
#include "core/resources.hpp"
#include "core/result.hpp"

namespace clew::classify {

/// Kohonen's self-organising map of Krishna & Kalra 2000, section 3.2.1 and appendix A: a lattice
/// of 7 x 7 neurons, each a landmark vector, and beside it the lattice of lower bounds. Trained
/// before the run, never changed in it.
class Som {
 public:
  static constexpr std::size_t kRows = 7;
  static constexpr std::size_t kColumns = 7;
  static constexpr std::size_t kNeurons = kRows * kColumns;

  struct Neuron {
    std::array<double, 3> weights{};         ///< classes, 0..8
    std::optional<RunLengths> lower_bounds;  ///< none: it stands for no landmark, and never wins
  };
  using Lattice = std::array<Neuron, kNeurons>;  ///< row by row

  struct Recall {
    std::uint32_t neuron = 0;
    double distance = 0.0;  ///< Euclidean, in classes
  };

  /// Reads a trained map. Refused: another format, keys that are unknown or missing, another number
  /// of neurons, weights outside 0..8, lower bounds that are no counts.
  static core::Result<Som> parse(const core::Resource& resource);

  explicit Som(const Lattice& lattice) : lattice_(lattice) {}

  /// The neuron nearest to a landmark vector, the first of several: appendix A.
  Recall recall(const Triple& classes) const;

  const Neuron& neuron(std::uint32_t index) const { return lattice_[index]; }

 private:
  Lattice lattice_;
};

}  // namespace clew::classify

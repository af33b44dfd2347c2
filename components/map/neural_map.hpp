// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "core/result.hpp"
#include "map/grid.hpp"
#include "map/lattice.hpp"

namespace clew::map {

/// A field of neurons, one a cell, whose activation at rest grows towards the nearest target from
/// wherever there is a way to one (Lagoudakis & Maida 1999, "Neural Maps for Global Path
/// Planning"):
///
///     v_i = 1 at a target, 0 at a blocked cell, and elsewhere
///     v_i = phi(sum_j w_ij v_j),  phi(x) = 0 for x <= 0, tanh(gain x) above.
///
/// *Deviation:* cells may be dear, with the least gain that there is in place of the map's: from
/// one to the next, activation falls as over some five others at the default gain, so that ways
/// lead through them where they must, and by the shortest piece. Nothing else differs for them.
///
/// It evolves from zero by sequential rasters from corner to corner, each of the four in turn: the
/// paper's pattern. So activation only grows, and as gain times the sum of a cell's weights is
/// below 1, a neighbour of each active cell was and is higher than it: at any time, at rest or not,
/// targets are the only local maxima, and steepest ascent ends at one. That holds for a gain of
/// each cell as for one of all.
///
/// Activation falls by a factor of three a cell and more, and plain doubles would be flat zero
/// some 300 cells out. An activation is a mantissa in (2^-340, 1] and a depth, mantissa *
/// 2^(-340 depth), in one way only. Rows are worked on in chunks of 32 cells; where all that a
/// chunk reads has one depth or two that follow each other, which most have, that is plain
/// arithmetic. A chunk is worked on again only if something that it reads has changed, bit for bit,
/// since it last was: no raster could change it otherwise. tanh is the identity in double precision
/// but near targets.
///
/// What is far from the targets rests only after what is near. So an evolution to rest holds the
/// rasters within a horizon, a least activation, which it lowers whenever all above it rests: the
/// time then does not grow with the number of cells times the longest way. With a start,
/// the horizon is the start's own activation as soon as it has one, since the way up from there
/// does not lead below it, and growth by less than a millionth is not passed on.
///
/// 12 bytes a cell, a byte for what it is, and one more for its part of a chunk.
class NeuralMap {
 public:
  struct Parameters {
    Lattice lattice = Lattice::kEightNeighbours;
    /// Steepest slope of phi: from kLeastGain, and below 1 / eigenvalue_bound(lattice).
    double gain = 0.1;
  };
  static constexpr double kLeastGain = 0.001;

  /// What evolve() is told of a cell.
  enum Passable : std::uint8_t { kBlocked = 0, kFree = 1, kDear = 2 };

  /// How an evolution ended.
  struct Evolution {
    int patterns = 0;      ///< of four rasters each
    bool at_rest = false;  ///< the last pattern passed nothing on
  };

  /// The error says what gain the lattice allows.
  static core::Result<NeuralMap> create(const Parameters& parameters);

  /// Evolves the map of `grid` from zero, to rest, or, with a `start`, until a whole pattern of
  /// rasters has reached it and left the order of activations around it as it was, or has reached
  /// nothing new without it: then there is no way. What is farther from the targets than the start
  /// may then be active or not. The start may lie on any cell. Allocates only
  /// for a grid larger than all before it.
  ///
  /// passable: one Passable a cell of the grid. Of `targets`, those that are blocked or lie outside
  /// the grid do not count.
  Evolution evolve(const Grid& grid, const std::vector<std::uint8_t>& passable,
                   const std::vector<Cell>& targets, const std::optional<Cell>& start = {});

  /// Laid out in lattice().
  const Grid& grid() const { return grid_; }
  Lattice lattice() const { return parameters_.lattice; }

  /// Whether the cell's activation is above zero: false for what is blocked, outside the grid, or
  /// not connected to any target.
  bool active(const Cell& cell) const;
  /// Whether `a` is more strongly activated than `b`. Cells outside the grid have no activation.
  bool above(const Cell& a, const Cell& b) const;
  /// Natural logarithm of the activation, in (-inf, 0]; -inf where it is zero.
  double log_activation(const Cell& cell) const;

  /// The neighbour with the highest activation, the first of neighbours() among equals; none at a
  /// target and where nothing is active.
  std::optional<Cell> ascent(const Cell& cell) const;
  /// Follows the ascent from `from` to a target, both included. False and no path if `from` is
  /// not active.
  bool path(const Cell& from, std::vector<Cell>& cells) const;

 private:
  enum class Kind : std::uint8_t { kBlocked, kFree, kDear, kTarget };
  static constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

  /// kChunk cells of a row that are worked on together.
  struct Chunk {
    std::uint64_t changed_at = 0;  ///< by clock_
    std::uint64_t updated_at = 0;
    std::int32_t least_depth = 0;  ///< of its active cells
    std::int32_t greatest_depth = -1;
    std::int64_t fall_bits = kNever;  ///< of its highest activation: -log2, rounded up
  };
  /// The direction of a raster along one axis: +1 or -1.
  struct Raster {
    std::int32_t column_step;
    std::int32_t row_step;
  };
  struct Span;
  struct Rows;
  struct DepthRange {
    std::int32_t least = -1;
    std::int32_t greatest = -1;
  };
  struct Activation {
    double mantissa;
    std::int32_t depth;
  };

  explicit NeuralMap(const Parameters& parameters) : parameters_(parameters) {}

  void clear(const Grid& grid, const std::vector<std::uint8_t>& passable,
             const std::vector<Cell>& targets);
  Evolution evolve_until_reached(const Cell& start);
  Evolution evolve_to_rest();
  template <typename Horizon>
  bool sweep_pattern(const Horizon& horizon_bits);
  void sweep(const Raster& raster, std::int64_t horizon_bits);
  bool due(std::int32_t row, std::int32_t chunk, std::int64_t horizon_bits);
  bool update(std::int32_t row, std::int32_t chunk, std::int32_t column_step);
  Span span_of(std::int32_t row, std::int32_t chunk) const;
  DepthRange depths_of(const Span& span) const;
  void copy_scaled(const Span& span, std::int32_t depth, double* values) const;
  template <bool kNearTarget>
  bool update_flat(const Span& span, const Rows& rows, std::int32_t column_step,
                   std::int32_t depth);
  template <bool kNearTarget>
  void activate(const Span& span, double fresh, std::int32_t column_step, double* sums) const;
  void take_over(const Span& span, const Rows& rows, const double* fresh, std::int32_t depth);
  void store(std::size_t at, double value, std::int32_t depth);
  bool update_stepped(const Span& span, std::int32_t column_step);
  Activation fresh_activation(const Span& span, std::size_t at) const;
  void note_activations(const Span& span);
  std::int64_t fall_bits(const Cell& cell) const;

  std::size_t padded(const Cell& cell) const {
    return (static_cast<std::size_t>(cell.row) + 1) * stride_ +
           static_cast<std::size_t>(cell.column) + 1;
  }
  Chunk& chunk_at(std::int32_t row, std::int32_t chunk) {
    return chunks_[(static_cast<std::size_t>(row) + 1) * chunk_stride_ +
                   static_cast<std::size_t>(chunk) + 1];
  }
  const Chunk& chunk_at(std::int32_t row, std::int32_t chunk) const {
    return const_cast<NeuralMap*>(this)->chunk_at(row, chunk);
  }

  Parameters parameters_;
  Grid grid_;
  // With a border of one blocked cell, and of one chunk, on each side.
  std::size_t stride_ = 0;
  std::size_t chunk_stride_ = 0;
  std::vector<double> mantissas_;  // 0 where not active
  std::vector<std::int32_t> depths_;
  std::vector<Kind> kinds_;
  std::vector<Chunk> chunks_;
  std::uint64_t clock_ = 0;  // updates of chunks so far
  std::size_t active_cells_ = 0;
  double change_ = 1.0;     // growth by more than this factor is passed on
  bool held_back_ = false;  // a chunk beyond the horizon was left for later
};

}  // namespace clew::map

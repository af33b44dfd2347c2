// SPDX-License-Identifier: Apache-2.0
#include "map/neural_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "core/check.hpp"
#include "core/math.hpp"
#include "map/neural_chunk.hpp"

namespace clew::map {
namespace {

// How far the horizon moves at a time: some 60 cells in the open.
constexpr std::int64_t kHorizonBits = 96;

// Growth by less than this share is not passed on where only the ways to a start are asked for.
constexpr double kNoticed = 0x1p-20;

// The order of activations around a cell, highest first, by index in neighbours().
using Order = std::array<std::uint8_t, kMaxNeighbours>;

Order order_around(const NeuralMap& map, const Cell& cell) {
  const Neighbours around = neighbours(map.lattice(), cell);
  Order order{};
  for (std::size_t i = 0; i < around.size(); ++i) order[i] = static_cast<std::uint8_t>(i);
  // Insertion sort is stable, and needs no memory.
  for (std::size_t i = 1; i < around.size(); ++i) {
    for (std::size_t k = i; k > 0 && map.above(around[order[k]], around[order[k - 1]]); --k) {
      std::swap(order[k], order[k - 1]);
    }
  }
  return order;
}

}  // namespace

core::Result<NeuralMap> NeuralMap::create(const Parameters& parameters) {
  const double limit = 1.0 / eigenvalue_bound(parameters.lattice);
  if (!(parameters.gain >= kLeastGain && parameters.gain < limit)) {
    return core::Error{"gain is " + std::to_string(parameters.gain) + "; allowed: from " +
                       std::to_string(kLeastGain) + ", and below " + std::to_string(limit) +
                       ", where the neural map on this lattice would not come to rest"};
  }
  return NeuralMap(parameters);
}

NeuralMap::Evolution NeuralMap::evolve(const Grid& grid, const std::vector<std::uint8_t>& passable,
                                       const std::vector<Cell>& targets,
                                       const std::optional<Cell>& start) {
  CLEW_CHECK(passable.size() == grid.size(),
             std::to_string(passable.size()) + " flags for " + std::to_string(grid.size()));
  clear(grid, passable, targets);
  return start.has_value() ? evolve_until_reached(*start) : evolve_to_rest();
}

/// Sweeps the four crossing rasters over all that is not beyond the horizon, -log2 of an
/// activation, asked for before each. False if nothing was left to update there.
template <typename Horizon>
bool NeuralMap::sweep_pattern(const Horizon& horizon_bits) {
  const std::uint64_t before = clock_;
  held_back_ = false;
  for (const Raster& raster : {Raster{1, 1}, Raster{-1, -1}, Raster{-1, 1}, Raster{1, -1}}) {
    sweep(raster, horizon_bits());
  }
  return clock_ != before;
}

NeuralMap::Evolution NeuralMap::evolve_until_reached(const Cell& start) {
  Evolution evolution;
  std::optional<Order> order_before;
  change_ = 1.0 + kNoticed;
  while (!evolution.at_rest) {
    const std::size_t active_before = active_cells_;
    // The way up from the start does not lead where activation is lower than there.
    const auto horizon_bits = [&] { return active(start) ? fall_bits(start) : kNever; };
    evolution.at_rest = !sweep_pattern(horizon_bits) && !held_back_;
    ++evolution.patterns;
    if (!active(start)) {
      if (active_cells_ == active_before) break;  // what has not been reached cannot be
      continue;
    }
    const Order order = order_around(*this, start);
    if (order_before == order) break;
    order_before = order;
  }
  return evolution;
}

NeuralMap::Evolution NeuralMap::evolve_to_rest() {
  Evolution evolution;
  change_ = 1.0;
  for (std::int64_t horizon_bits = kHorizonBits; !evolution.at_rest;) {
    const bool changed = sweep_pattern([&] { return horizon_bits; });
    ++evolution.patterns;
    if (changed) continue;
    evolution.at_rest = !held_back_;
    horizon_bits += kHorizonBits;
  }
  return evolution;
}

void NeuralMap::clear(const Grid& grid, const std::vector<std::uint8_t>& passable,
                      const std::vector<Cell>& targets) {
  grid_ = grid;
  stride_ = static_cast<std::size_t>(grid.columns) + 2;
  // One more, since cells are worked on in pairs.
  const std::size_t size = stride_ * (static_cast<std::size_t>(grid.rows) + 2) + 1;
  mantissas_.assign(size, 0.0);
  depths_.assign(size, 0);
  kinds_.assign(size, Kind::kBlocked);
  chunk_stride_ = static_cast<std::size_t>((grid.columns + kChunk - 1) / kChunk) + 2;
  clock_ = 1;
  active_cells_ = 0;
  Chunk untouched;
  untouched.updated_at = clock_;
  chunks_.assign(chunk_stride_ * (static_cast<std::size_t>(grid.rows) + 2), untouched);

  for (std::int32_t row = 0; row < grid.rows; ++row) {
    const std::uint8_t* from = passable.data() + grid.index({0, row});
    Kind* to = kinds_.data() + padded({0, row});
    for (std::int32_t i = 0; i < grid.columns; ++i) {
      to[i] = from[i] == kBlocked ? Kind::kBlocked : from[i] == kDear ? Kind::kDear : Kind::kFree;
    }
  }
  for (const Cell& target : targets) {
    if (!grid.contains(target) || passable[grid.index(target)] == 0) continue;
    kinds_[padded(target)] = Kind::kTarget;
    if (mantissas_[padded(target)] == 0.0) ++active_cells_;
    mantissas_[padded(target)] = 1.0;
    Chunk& chunk = chunk_at(target.row, target.column / kChunk);
    chunk.changed_at = clock_;
    chunk.greatest_depth = 0;
    chunk.fall_bits = 0;
  }
}

void NeuralMap::sweep(const Raster& raster, std::int64_t horizon_bits) {
  const auto chunk_count = static_cast<std::int32_t>(chunk_stride_) - 2;
  for (std::int32_t i = 0; i < grid_.rows; ++i) {
    const std::int32_t row = raster.row_step > 0 ? i : grid_.rows - 1 - i;
    for (std::int32_t k = 0; k < chunk_count; ++k) {
      const std::int32_t chunk = raster.column_step > 0 ? k : chunk_count - 1 - k;
      if (!due(row, chunk, horizon_bits)) continue;
      const bool changed = update(row, chunk, raster.column_step);
      Chunk& updated = chunk_at(row, chunk);
      updated.updated_at = ++clock_;
      if (changed) updated.changed_at = clock_;
    }
  }
}

/// Whether something that the chunk reads has changed since it was updated, and some of it is above
/// the horizon.
bool NeuralMap::due(std::int32_t row, std::int32_t chunk, std::int64_t horizon_bits) {
  const Chunk* own = &chunk_at(row, chunk);
  std::uint64_t latest = 0;
  std::int64_t least_fall_bits = kNever;
  for (const Chunk* middle : {own - chunk_stride_, own, own + chunk_stride_}) {
    for (const Chunk* read = middle - 1; read <= middle + 1; ++read) {
      latest = std::max(latest, read->changed_at);
      least_fall_bits = std::min(least_fall_bits, read->fall_bits);
    }
  }
  if (latest < own->updated_at) return false;
  if (least_fall_bits <= horizon_bits) return true;
  held_back_ = true;
  return false;
}

std::int64_t NeuralMap::fall_bits(const Cell& cell) const {
  const std::size_t at = padded(cell);
  return std::int64_t{depths_[at]} * kBandBits - std::ilogb(mantissas_[at]);
}

bool NeuralMap::active(const Cell& cell) const {
  return grid_.contains(cell) && mantissas_[padded(cell)] > 0.0;
}

bool NeuralMap::above(const Cell& a, const Cell& b) const {
  if (!active(a)) return false;
  if (!active(b)) return true;
  const std::size_t at_a = padded(a);
  const std::size_t at_b = padded(b);
  if (depths_[at_a] != depths_[at_b]) return depths_[at_a] < depths_[at_b];
  return mantissas_[at_a] > mantissas_[at_b];
}

double NeuralMap::log_activation(const Cell& cell) const {
  if (!active(cell)) return -std::numeric_limits<double>::infinity();
  const std::size_t at = padded(cell);
  return core::log(mantissas_[at]) + depths_[at] * core::log(kBand);
}

std::optional<Cell> NeuralMap::ascent(const Cell& cell) const {
  if (!active(cell) || kinds_[padded(cell)] == Kind::kTarget) return std::nullopt;
  std::optional<Cell> highest;
  for (const Cell& neighbour : neighbours(parameters_.lattice, cell)) {
    if (active(neighbour) && (!highest.has_value() || above(neighbour, *highest))) {
      highest = neighbour;
    }
  }
  return highest;
}

bool NeuralMap::path(const Cell& from, std::vector<Cell>& cells) const {
  cells.clear();
  if (!active(from)) return false;
  for (std::optional<Cell> next = from; next.has_value(); next = ascent(*next)) {
    cells.push_back(*next);
  }
  return true;
}

}  // namespace clew::map

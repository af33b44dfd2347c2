// SPDX-License-Identifier: Apache-2.0
#include "map/neural_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "core/check.hpp"
#include "core/math.hpp"

namespace clew::map {
namespace {

constexpr std::int32_t kChunk = 32;

// Of the mantissas: 2^-480 and its inverse. Products of two of them, and values 32 cells on at the
// least gain, are normal doubles yet.
constexpr int kBandBits = 480;
constexpr double kBand = 0x1p-480;
constexpr double kBandInverse = 0x1p480;

// How far the horizon moves at a time: some 60 cells in the open.
constexpr std::int64_t kHorizonBits = 96;

constexpr double kLeastGain = 0.001;

// Below it, tanh(x) = x (1 - x^2 / 3 + ...) is x to half a unit in the last place.
constexpr double kLinearBelow = 0x1p-27;

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

double scale(std::int32_t depths_below) {
  if (depths_below == 0) return 1.0;
  return depths_below == 1 ? kBand : 0.0;
}

double phi(double x) { return x < kLinearBelow ? x : core::tanh(x); }

}  // namespace

/// The cells of a chunk: indices in the padded arrays.
struct NeuralMap::Span {
  std::size_t begin;
  std::size_t above;  // of the cell at begin, in the row of lower number
  std::size_t below;
  std::size_t length;
  std::int32_t row;
  std::int32_t chunk;
};

core::Result<NeuralMap> NeuralMap::create(const Parameters& parameters) {
  const double limit = 1.0 / eigenvalue_bound(parameters.lattice);
  if (!(parameters.gain >= kLeastGain && parameters.gain < limit)) {
    return core::Error{"gain is " + std::to_string(parameters.gain) + "; allowed: from " +
                           std::to_string(kLeastGain) + ", and below " + std::to_string(limit) +
                           ", where the neural map on this lattice would not come to rest",
                       {},
                       0,
                       0};
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

NeuralMap::Evolution NeuralMap::evolve_until_reached(const Cell& start) {
  Evolution evolution;
  std::optional<Order> order_before;
  while (!evolution.at_rest) {
    const std::size_t active_before = active_cells_;
    evolution.at_rest = !sweep_pattern(kNever);
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
  for (std::int64_t horizon_bits = kHorizonBits; !evolution.at_rest;) {
    const bool changed = sweep_pattern(horizon_bits);
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
  const std::size_t size = stride_ * (static_cast<std::size_t>(grid.rows) + 2);
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
      to[i] = from[i] != 0 ? Kind::kFree : Kind::kBlocked;
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

/// Sweeps the four crossing rasters over all that is not beyond the horizon, -log2 of an
/// activation. False if nothing was left to update there.
bool NeuralMap::sweep_pattern(std::int64_t horizon_bits) {
  const std::uint64_t before = clock_;
  held_back_ = false;
  for (const Raster& raster : {Raster{1, 1}, Raster{-1, -1}, Raster{-1, 1}, Raster{1, -1}}) {
    sweep(raster, horizon_bits);
  }
  return clock_ != before;
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

bool NeuralMap::update(std::int32_t row, std::int32_t chunk, std::int32_t column_step) {
  const Span span = span_of(row, chunk);
  const std::optional<std::int32_t> depth = common_depth(span);
  if (!depth.has_value()) return update_stepped(span, column_step);
  return *depth == 0 ? update_flat<true>(span, column_step, 0)
                     : update_flat<false>(span, column_step, *depth);
}

NeuralMap::Span NeuralMap::span_of(std::int32_t row, std::int32_t chunk) const {
  const std::int32_t first = chunk * kChunk;
  const std::size_t begin = padded({first, row});
  const auto length = static_cast<std::size_t>(std::min(kChunk, grid_.columns - first));
  return {begin, begin - stride_, begin + stride_, length, row, chunk};
}

/// The depth of all active cells that the span reads; none if they differ.
std::optional<std::int32_t> NeuralMap::common_depth(const Span& span) const {
  std::int32_t least = std::numeric_limits<std::int32_t>::max();
  std::int32_t greatest = -1;
  for (std::int32_t row = span.row - 1; row <= span.row + 1; ++row) {
    const Chunk& chunk = chunk_at(row, span.chunk);
    if (chunk.greatest_depth < 0) continue;
    least = std::min(least, chunk.least_depth);
    greatest = std::max(greatest, chunk.greatest_depth);
  }
  for (const std::size_t begin : {span.above, span.begin, span.below}) {
    for (const std::size_t edge : {begin - 1, begin + span.length}) {
      if (mantissas_[edge] == 0.0) continue;
      least = std::min(least, depths_[edge]);
      greatest = std::max(greatest, depths_[edge]);
    }
  }
  if (greatest < 0) return 0;
  if (least != greatest) return std::nullopt;
  return least;
}

/// Updates a chunk of which all that it reads has the same depth, as plain doubles of that depth.
template <bool kNearTarget>
bool NeuralMap::update_flat(const Span& span, std::int32_t column_step, std::int32_t depth) {
  const RowLinks links = row_links(parameters_.lattice, span.row);
  std::array<double, kChunk + 2> columns;  // above and below a column, from the one on the left
  for (std::size_t i = 0; i < span.length + 2; ++i) {
    columns[i] = mantissas_[span.above - 1 + i] + mantissas_[span.below - 1 + i];
  }
  std::array<double, kChunk> sums;  // all but the neighbour that the raster comes from
  const double* ahead = mantissas_.data() + span.begin + column_step;
  for (std::size_t i = 0; i < span.length; ++i) {
    sums[i] =
        (columns[i + 1] + (links.left * columns[i] + links.right * columns[i + 2])) + ahead[i];
  }
  const double gain = parameters_.gain;
  const std::array<double, 3> gains = {0.0, gain, 0.0};  // by Kind
  std::size_t i = column_step > 0 ? 0 : span.length - 1;
  const auto step = static_cast<std::size_t>(column_step);  // wraps around, as i does
  double* mantissas = mantissas_.data() + span.begin;
  const Kind* kinds = kinds_.data() + span.begin;
  double fresh = mantissas[i - step];
  bool changed = false;
  for (; i < span.length; i += step) {
    fresh = (sums[i] + fresh) * gains[static_cast<std::size_t>(kinds[i])];
    if (kNearTarget) {
      fresh = phi(fresh);
      if (kinds[i] == Kind::kTarget) fresh = 1.0;
    }
    // What is rounded differently by another raster must not make it fall again.
    if (!(fresh > mantissas[i])) continue;
    const bool sinks = !(fresh > kBand);
    if (mantissas[i] == 0.0) ++active_cells_;
    mantissas[i] = sinks ? fresh * kBandInverse : fresh;
    depths_[span.begin + i] = sinks ? depth + 1 : depth;
    changed = true;
  }
  if (changed) note_activations(span);
  return changed;
}

/// Updates a chunk cell by cell, each with the depths of its own neighbours.
bool NeuralMap::update_stepped(const Span& span, std::int32_t column_step) {
  bool changed = false;
  std::size_t i = column_step > 0 ? 0 : span.length - 1;
  for (; i < span.length; i += static_cast<std::size_t>(column_step)) {
    const std::size_t at = span.begin + i;
    if (kinds_[at] != Kind::kFree) continue;
    const Activation fresh = fresh_activation(span, i);
    const bool higher = mantissas_[at] == 0.0 || fresh.depth < depths_[at] ||
                        (fresh.depth == depths_[at] && fresh.mantissa > mantissas_[at]);
    if (fresh.mantissa == 0.0 || !higher) continue;
    if (mantissas_[at] == 0.0) ++active_cells_;
    mantissas_[at] = fresh.mantissa;
    depths_[at] = fresh.depth;
    changed = true;
  }
  if (changed) note_activations(span);
  return changed;
}

/// What the cell at `offset` of the span is activated to by its neighbours.
NeuralMap::Activation NeuralMap::fresh_activation(const Span& span, std::size_t offset) const {
  std::array<double, 9> around;
  std::array<std::int32_t, 9> depths;
  std::int32_t least = std::numeric_limits<std::int32_t>::max();
  std::size_t count = 0;
  for (const std::size_t row : {span.above, span.begin, span.below}) {
    for (std::size_t at = row + offset - 1; at <= row + offset + 1; ++at, ++count) {
      around[count] = mantissas_[at];
      depths[count] = depths_[at];
      const bool counts = around[count] > 0.0 && at != span.begin + offset;
      if (counts) least = std::min(least, depths[count]);
    }
  }
  for (std::size_t i = 0; i < around.size(); ++i) {
    if (around[i] > 0.0) around[i] *= scale(std::max(0, depths[i] - least));
  }
  const RowLinks links = row_links(parameters_.lattice, span.row);
  const double sum = (around[1] + around[7]) +
                     (links.left * (around[0] + around[6]) + links.right * (around[2] + around[8]));
  Activation fresh{(sum + (around[3] + around[5])) * parameters_.gain, least};
  if (least == 0) fresh.mantissa = phi(fresh.mantissa);
  if (fresh.mantissa > 0.0 && !(fresh.mantissa > kBand)) {
    fresh.mantissa *= kBandInverse;
    ++fresh.depth;
  }
  return fresh;
}

/// Notes in the chunk of `span` what its activations have become.
void NeuralMap::note_activations(const Span& span) {
  std::int32_t least = std::numeric_limits<std::int32_t>::max();
  std::int32_t greatest = -1;
  double highest = 0.0;
  for (std::size_t at = span.begin; at < span.begin + span.length; ++at) {
    if (mantissas_[at] == 0.0) continue;
    if (depths_[at] < least) highest = 0.0;
    least = std::min(least, depths_[at]);
    greatest = std::max(greatest, depths_[at]);
    if (depths_[at] == least) highest = std::max(highest, mantissas_[at]);
  }
  Chunk& chunk = chunk_at(span.row, span.chunk);
  chunk.least_depth = least;
  chunk.greatest_depth = greatest;
  chunk.fall_bits = std::int64_t{least} * kBandBits - std::ilogb(highest);
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

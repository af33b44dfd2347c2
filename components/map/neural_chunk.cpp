// SPDX-License-Identifier: Apache-2.0
/// The updates of a neural map, chunk by chunk.
#include "map/neural_chunk.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/math.hpp"

namespace clew::map {
namespace {

// Below it, tanh(x) = x (1 - x^2 / 3 + ...) is x to half a unit in the last place.
constexpr double kLinearBelow = 0x1p-27;

double scale(std::int32_t depths_below) {
  if (depths_below == 0) return 1.0;
  return depths_below == 1 ? kBand : 0.0;
}

/// How many bands deeper than 1 a value is.
std::int32_t bands_below(double value) {
  return value > kBand ? 0 : (value * kBandInverse > kBand ? 1 : 2);
}

double phi(double x) { return x < kLinearBelow ? x : core::tanh(x); }

/// Cells that are worked on at once. Each lane is plain arithmetic, so any processor gives its
/// bits.
using Lanes [[gnu::vector_size(2 * sizeof(double))]] = double;
constexpr std::size_t kLanes = 2;

Lanes load(const double* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof(lanes));
  return lanes;
}

void store_lanes(const Lanes& lanes, double* to) { std::memcpy(to, &lanes, sizeof(lanes)); }

/// Of each cell of a row, the weighted sum of all neighbours but the one that the raster comes
/// from.
template <typename Rows>
void sum_up(const Rows& rows, const RowLinks& links, std::int32_t column_step, std::size_t length,
            double* sums) {
  const Lanes left = {links.left, links.left};
  const Lanes right = {links.right, links.right};
  for (std::size_t i = 0; i < length; i += kLanes) {
    const double* above = rows.above + i;
    const double* below = rows.below + i;
    const Lanes column = load(above) + load(below);
    const Lanes sides =
        left * (load(above - 1) + load(below - 1)) + right * (load(above + 1) + load(below + 1));
    store_lanes((column + sides) + load(rows.own + i + column_step), sums + i);
  }
}

/// Of a row of activations of one depth, which stay of it. A lane beyond the row is of the border,
/// and zero.
void keep_higher(const double* fresh, std::size_t length, double* own) {
  for (std::size_t i = 0; i < length; i += kLanes) {
    const Lanes before = load(own + i);
    const Lanes offered = load(fresh + i);
    store_lanes(offered > before ? offered : before, own + i);
  }
}

}  // namespace

bool NeuralMap::update(std::int32_t row, std::int32_t chunk, std::int32_t column_step) {
  const Span span = span_of(row, chunk);
  const DepthRange depths = depths_of(span);
  if (depths.greatest > depths.least + 1) return update_stepped(span, column_step);
  if (depths.greatest <= depths.least) {
    const Rows rows = {mantissas_.data() + span.above, mantissas_.data() + span.begin,
                       mantissas_.data() + span.below};
    return depths.least <= 0 ? update_flat<true>(span, rows, column_step, 0)
                             : update_flat<false>(span, rows, column_step, depths.least);
  }
  std::array<double, 3 * (kChunk + 2)> values{};
  const Rows rows = {values.data() + 1, values.data() + 1 + (kChunk + 2),
                     values.data() + 1 + 2 * (kChunk + 2)};
  copy_scaled(span, depths.least, values.data());
  return depths.least == 0 ? update_flat<true>(span, rows, column_step, 0)
                           : update_flat<false>(span, rows, column_step, depths.least);
}

/// The rows that the span reads, from the left of it to its right, as plain doubles of a depth.
void NeuralMap::copy_scaled(const Span& span, std::int32_t depth, double* values) const {
  for (const std::size_t begin : {span.above, span.begin, span.below}) {
    for (std::size_t i = 0; i < span.length + 2; ++i) {
      const std::size_t at = begin - 1 + i;
      values[i] = depths_[at] > depth ? mantissas_[at] * kBand : mantissas_[at];
    }
    values += kChunk + 2;
  }
}

NeuralMap::Span NeuralMap::span_of(std::int32_t row, std::int32_t chunk) const {
  const std::int32_t first = chunk * kChunk;
  const std::size_t begin = padded({first, row});
  const auto length = static_cast<std::size_t>(std::min(kChunk, grid_.columns - first));
  return {begin, begin - stride_, begin + stride_, length, row, chunk};
}

/// The depths of all active cells that the span reads; -1 to -1 without any.
NeuralMap::DepthRange NeuralMap::depths_of(const Span& span) const {
  DepthRange own{std::numeric_limits<std::int32_t>::max(), -1};
  DepthRange beside = own;  // of the chunks to the left and right
  const auto take_in = [](DepthRange& range, std::int32_t least, std::int32_t greatest) {
    if (greatest < 0) return;
    range.least = std::min(range.least, least);
    range.greatest = std::max(range.greatest, greatest);
  };
  for (std::int32_t row = span.row - 1; row <= span.row + 1; ++row) {
    const Chunk* middle = &chunk_at(row, span.chunk);
    take_in(own, middle->least_depth, middle->greatest_depth);
    for (const Chunk* side : {middle - 1, middle + 1}) {
      take_in(beside, side->least_depth, side->greatest_depth);
    }
  }
  if (own.greatest < 0 && beside.greatest < 0) return {};
  // Their cells next to the span need a look only if they may differ.
  if (std::min(own.least, beside.least) == std::max(own.greatest, beside.greatest)) {
    return {std::min(own.least, beside.least), std::max(own.greatest, beside.greatest)};
  }
  for (const std::size_t begin : {span.above, span.begin, span.below}) {
    for (const std::size_t edge : {begin - 1, begin + span.length}) {
      if (mantissas_[edge] > 0.0) take_in(own, depths_[edge], depths_[edge]);
    }
  }
  return own.greatest < 0 ? DepthRange{} : own;
}

/// Updates a chunk of which all that it reads is given in plain doubles of one depth.
template <bool kNearTarget>
bool NeuralMap::update_flat(const Span& span, const Rows& rows, std::int32_t column_step,
                            std::int32_t depth) {
  std::array<double, kChunk> fresh;
  sum_up(rows, row_links(parameters_.lattice, span.row), column_step, span.length, fresh.data());
  activate<kNearTarget>(span, (column_step > 0 ? rows.own[-1] : rows.own[span.length]), column_step,
                        fresh.data());
  // The border beside an odd chunk's end is blocked.
  if (span.length % kLanes != 0) fresh[span.length] = 0.0;
  Lanes highest = {0.0, 0.0};
  Lanes lowest = {HUGE_VAL, HUGE_VAL};
  auto grown = highest > lowest;  // none
  auto noticed = grown;
  auto roused = grown;  // counts from zero down
  for (std::size_t i = 0; i < span.length; i += kLanes) {
    const Lanes before = load(rows.own + i);
    const Lanes offered = load(fresh.data() + i);
    // What is rounded differently by another raster must not make it fall again.
    const auto higher = offered > before;
    const Lanes now = higher ? offered : before;
    grown |= higher;
    roused += higher & (before == 0.0);
    noticed |= offered > before * change_;
    highest = now > highest ? now : highest;
    lowest = (now > 0.0) & (now < lowest) ? now : lowest;
  }
  const double most = std::max(highest[0], highest[1]);
  const double least = std::min(lowest[0], lowest[1]);
  if ((grown[0] | grown[1]) != 0) {
    double* own = mantissas_.data() + span.begin;
    if (rows.own == own && least > kBand) {
      const auto count = static_cast<std::size_t>(-(roused[0] + roused[1]));
      active_cells_ += count;
      if (count > 0) std::fill_n(depths_.data() + span.begin, span.length, depth);
      keep_higher(fresh.data(), span.length, own);
    } else {
      take_over(span, rows, fresh.data(), depth);
    }
  }
  if (most > 0.0) {
    Chunk& chunk = chunk_at(span.row, span.chunk);
    chunk.least_depth = depth + bands_below(most);
    chunk.greatest_depth = depth + bands_below(least);
    chunk.fall_bits = std::int64_t{depth} * kBandBits - std::ilogb(most);
  }
  return (noticed[0] | noticed[1]) != 0;
}

/// Turns the sums of a chunk's cells into activations, along the raster, which comes from a
/// neighbour with the activation `fresh`.
template <bool kNearTarget>
void NeuralMap::activate(const Span& span, double fresh, std::int32_t column_step,
                         double* sums) const {
  const std::array<double, 4> gains = {0.0, parameters_.gain, kLeastGain, 0.0};  // by Kind
  const Kind* kinds = kinds_.data() + span.begin;
  std::size_t i = column_step > 0 ? 0 : span.length - 1;
  const auto step = static_cast<std::size_t>(column_step);  // wraps around, as i does
  for (; i < span.length; i += step) {
    fresh = (sums[i] + fresh) * gains[static_cast<std::size_t>(kinds[i])];
    if (kNearTarget) {
      fresh = phi(fresh);
      if (kinds[i] == Kind::kTarget) fresh = 1.0;
    }
    sums[i] = fresh;
  }
}

/// Stores the activations of a chunk's cells that have grown.
void NeuralMap::take_over(const Span& span, const Rows& rows, const double* fresh,
                          std::int32_t depth) {
  for (std::size_t i = 0; i < span.length; ++i) {
    const double before = rows.own[i];
    if (!(fresh[i] > before)) continue;
    if (before == 0.0) ++active_cells_;
    store(span.begin + i, fresh[i], depth);
  }
}

/// Sets an activation that is given as a plain double of a depth.
void NeuralMap::store(std::size_t at, double value, std::int32_t depth) {
  for (; !(value > kBand); ++depth) value *= kBandInverse;
  mantissas_[at] = value;
  depths_[at] = depth;
}

/// Updates a chunk cell by cell, each with the depths of its own neighbours.
bool NeuralMap::update_stepped(const Span& span, std::int32_t column_step) {
  bool changed = false;
  std::size_t i = column_step > 0 ? 0 : span.length - 1;
  for (; i < span.length; i += static_cast<std::size_t>(column_step)) {
    const std::size_t at = span.begin + i;
    if (kinds_[at] != Kind::kFree && kinds_[at] != Kind::kDear) continue;
    const Activation fresh = fresh_activation(span, i);
    const bool higher = mantissas_[at] == 0.0 || fresh.depth < depths_[at] ||
                        (fresh.depth == depths_[at] && fresh.mantissa > mantissas_[at]);
    if (fresh.mantissa == 0.0 || !higher) continue;
    if (mantissas_[at] == 0.0) ++active_cells_;
    changed = changed || mantissas_[at] == 0.0 || fresh.depth < depths_[at] ||
              fresh.mantissa > mantissas_[at] * change_;
    mantissas_[at] = fresh.mantissa;
    depths_[at] = fresh.depth;
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
  const bool dear = kinds_[span.begin + offset] == Kind::kDear;
  const double gain = dear ? kLeastGain : parameters_.gain;
  Activation fresh{(sum + (around[3] + around[5])) * gain, least};
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

}  // namespace clew::map

// SPDX-License-Identifier: Apache-2.0
#include "map/tile_index.hpp"

#include <algorithm>

namespace clew::map {
namespace {

constexpr std::int32_t kWordRows = 64;

/// Rounded down.
std::int32_t word_of(std::int32_t row) {
  return row >= 0 ? row / kWordRows : -((-(row + 1)) / kWordRows) - 1;
}

}  // namespace

void TileIndex::add(const TileKey& key) {
  std::vector<Word>& words = columns_[key.first];
  const std::int32_t number = word_of(key.second);
  auto at = std::lower_bound(words.begin(), words.end(), number,
                             [](const Word& word, std::int32_t n) { return word.number < n; });
  if (at == words.end() || at->number != number) at = words.insert(at, {number, 0});
  at->bits |= std::uint64_t{1} << (key.second - number * kWordRows);
}

std::optional<TileIndex::Rows> TileIndex::rows_between(std::int32_t column, std::int32_t first,
                                                       std::int32_t last) const {
  const auto found = columns_.find(column);
  if (found == columns_.end() || first > last) return std::nullopt;
  std::optional<Rows> rows;
  for (const Word& word : found->second) {
    const std::int32_t begin = word.number * kWordRows;
    std::uint64_t bits = word.bits;
    if (word.number < word_of(first) || word.number > word_of(last)) continue;
    if (word.number == word_of(first)) bits &= ~std::uint64_t{0} << (first - begin);
    if (word.number == word_of(last)) bits &= ~std::uint64_t{0} >> (begin + 63 - last);
    if (bits == 0) continue;
    if (!rows) rows = Rows{begin + static_cast<std::int32_t>(__builtin_ctzll(bits)), 0};
    rows->most = begin + 63 - static_cast<std::int32_t>(__builtin_clzll(bits));
  }
  return rows;
}

}  // namespace clew::map

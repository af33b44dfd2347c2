// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "map/tile_log.hpp"

namespace clew::map {

/// Where a map has tiles, a bit each: so that to find out does not mean to visit them.
class TileIndex {
 public:
  void clear() { columns_.clear(); }
  void add(const TileKey& key);

  /// The least and the greatest of a column's rows from `first` to `last`, both included; nothing
  /// if it has no tile there.
  struct Rows {
    std::int32_t least = std::numeric_limits<std::int32_t>::max();
    std::int32_t most = std::numeric_limits<std::int32_t>::min();
  };
  std::optional<Rows> rows_between(std::int32_t column, std::int32_t first,
                                   std::int32_t last) const;

 private:
  struct Word {
    std::int32_t number = 0;  // of rows, 64 each
    std::uint64_t bits = 0;
  };

  std::map<std::int32_t, std::vector<Word>> columns_;  // words by number
};

}  // namespace clew::map

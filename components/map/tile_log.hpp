// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace clew::map {

using TileKey = std::pair<std::int32_t, std::int32_t>;  ///< column and row of a tile

/// Which of a map's tiles have changed since when, for all who repair what they keep of them. It
/// remembers some thousand changes; who asks later than that is told that it does not know.
class TileLog {
 public:
  /// How far a reader has read.
  struct Position {
    std::shared_ptr<const char> log;  ///< which log; null: none
    std::uint64_t entries = 0;
  };

  TileLog() = default;
  /// A copy is another log: who has read the one knows nothing of the other.
  TileLog(const TileLog& other) : first_(other.entries()), round_(first_) {}
  TileLog& operator=(const TileLog& other);
  ~TileLog() = default;

  /// All may have changed.
  void begin_anew();
  /// From here on, tiles that change are noted again.
  void begin_round();
  /// A tile has changed; `noted` is its entry, 0 if it has none, and is kept with it.
  void note(const TileKey& key, std::uint64_t& noted) {
    if (noted > round_) return;
    keys_.push_back(key);
    noted = entries();
  }

  /// Finds the tiles that may have changed since, some more than once, and sets the position to
  /// where to read on. False if it does not know them.
  bool read(Position& position, std::vector<TileKey>& keys) const;

 private:
  /// The number of the last entry. It never shrinks, so that what a tile was noted as in a log that
  /// this one was copied from, or before it began anew, is of no round.
  std::uint64_t entries() const { return first_ + keys_.size(); }

  std::shared_ptr<const char> log_ = std::make_shared<char>();  // a reader keeps what it compares
  std::vector<TileKey> keys_;
  std::uint64_t first_ = 0;  // so many entries were forgotten
  std::uint64_t round_ = 0;  // so many were made before this round
};

}  // namespace clew::map

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace clew::map {

using TileKey = std::pair<std::int32_t, std::int32_t>;  ///< column and row of a tile

/// Which of a map's tiles have changed since when, for all who repair what they keep of them. It
/// remembers some thousand changes; who asks later than that is told that it does not know.
class TileLog {
 public:
  /// Of a log, how many entries had been made.
  struct Position {
    std::uint64_t log = 0;  ///< 0: none
    std::uint64_t entries = 0;
  };

  TileLog() : log_(next_log()) {}
  /// A copy is another log: who has read the one knows nothing of the other.
  TileLog(const TileLog& other) : TileLog() { static_cast<void>(other); }
  TileLog& operator=(const TileLog& other) {
    if (this != &other) begin_anew();
    return *this;
  }
  ~TileLog() = default;

  /// All may have changed.
  void begin_anew();
  /// From here on, tiles that change are noted again.
  void begin_round();
  /// A tile has changed; `noted` is where it was noted last, and is kept with it.
  void note(const TileKey& key, Position& noted) {
    if (noted.log == log_ && noted.entries > round_) return;
    keys_.push_back(key);
    noted = {log_, first_ + keys_.size()};
  }

  /// Finds the tiles that may have changed since, some more than once, and sets the position to
  /// where to read on. False if it does not know them.
  bool read(Position& position, std::vector<TileKey>& keys) const;

 private:
  static std::uint64_t next_log();

  std::uint64_t log_;  // no other one in this process has that number
  std::vector<TileKey> keys_;
  std::uint64_t first_ = 0;  // so many entries were forgotten
  std::uint64_t round_ = 0;  // so many were made before this round
};

}  // namespace clew::map

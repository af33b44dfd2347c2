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
  /// Of a log, how many entries had been made.
  struct Position {
    std::shared_ptr<const int> log;  ///< null: none
    std::uint64_t entries = 0;
  };

  TileLog() : log_(std::make_shared<const int>(0)) {}
  /// A copy is another log: who has read the one knows nothing of the other. It goes on with the
  /// same numbers, which the tiles keep.
  TileLog(const TileLog& other)
      : log_(std::make_shared<const int>(0)),
        keys_(other.keys_),
        first_(other.first_),
        round_(other.round_) {}
  TileLog& operator=(const TileLog& other) {
    if (this == &other) return *this;
    log_ = std::make_shared<const int>(0);
    keys_ = other.keys_;
    first_ = other.first_;
    round_ = other.round_;
    return *this;
  }
  ~TileLog() = default;

  /// All may have changed, and no tile was noted.
  void begin_anew();
  /// From here on, tiles that change are noted again.
  void begin_round();
  /// A tile has changed; `noted`, 0 at first, tells when it was noted last, and is kept with it.
  void note(const TileKey& key, std::uint64_t& noted) {
    if (noted > round_) return;
    keys_.push_back(key);
    noted = first_ + keys_.size();
  }

  /// Finds the tiles that may have changed since, some more than once, and sets the position to
  /// where to read on. False if it does not know them.
  bool read(Position& position, std::vector<TileKey>& keys) const;

 private:
  std::shared_ptr<const int> log_;  // whose address no other one has, as long as somebody knows it
  std::vector<TileKey> keys_;
  std::uint64_t first_ = 0;  // so many entries were forgotten
  std::uint64_t round_ = 0;  // so many were made before this round
};

}  // namespace clew::map

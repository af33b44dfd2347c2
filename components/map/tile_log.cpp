// SPDX-License-Identifier: Apache-2.0
#include "map/tile_log.hpp"

#include <algorithm>

namespace clew::map {
namespace {

constexpr std::size_t kMost = 8192;

}  // namespace

TileLog& TileLog::operator=(const TileLog& other) {
  if (this == &other) return *this;
  // The tiles come with it.
  first_ = std::max(entries(), other.entries());
  keys_.clear();
  begin_anew();
  return *this;
}

void TileLog::begin_anew() {
  log_ = std::make_shared<char>();
  first_ = entries();
  keys_.clear();
  round_ = first_;
}

void TileLog::begin_round() {
  if (keys_.size() > kMost) {
    keys_.erase(keys_.begin(), keys_.begin() + static_cast<std::ptrdiff_t>(kMost / 2));
    first_ += kMost / 2;
  }
  round_ = entries();
}

bool TileLog::read(Position& position, std::vector<TileKey>& keys) const {
  keys.clear();
  const bool knows = position.log == log_ && position.entries >= first_;
  if (knows) {
    const auto read = static_cast<std::ptrdiff_t>(position.entries - first_);
    keys.assign(keys_.begin() + read, keys_.end());
  }
  // What is noted in this round is not noted again if it changes once more.
  position = {log_, round_};
  return knows;
}

}  // namespace clew::map

// SPDX-License-Identifier: Apache-2.0
#include "map/tile_log.hpp"

namespace clew::map {
namespace {

constexpr std::size_t kMost = 8192;

}  // namespace

void TileLog::begin_anew() {
  log_ = std::make_shared<const int>(0);
  keys_.clear();
  first_ = 0;
  round_ = 0;
}

void TileLog::begin_round() {
  if (keys_.size() > kMost) {
    keys_.erase(keys_.begin(), keys_.begin() + static_cast<std::ptrdiff_t>(kMost / 2));
    first_ += kMost / 2;
  }
  round_ = first_ + keys_.size();
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

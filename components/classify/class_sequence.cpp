// SPDX-License-Identifier: Apache-2.0
#include "classify/class_sequence.hpp"

namespace clew::classify {

bool ClassSequence::add(std::uint8_t spatial_class) {
  Run& current = state_.current;
  if (current.length > 0 && current.spatial_class == spatial_class) {
    ++current.length;
    return false;
  }
  auto& ended = state_.ended;
  if (current.length > 0) {
    if (!ended.full()) {
      ended.push_back(current);
    } else if (sliding_) {
      ended[0] = ended[1];
      ended[1] = current;
    } else {
      ended.clear();
    }
  }
  current = {spatial_class, 1};
  return true;
}

Triple ClassSequence::classes() const {
  return {state_.ended[0].spatial_class, state_.ended[1].spatial_class,
          state_.current.spatial_class};
}

RunLengths ClassSequence::lengths() const {
  return {state_.ended[0].length, state_.ended[1].length, state_.current.length};
}

bool ClassSequence::is_valid() const {
  constexpr std::uint8_t kHighest = 8;
  for (const Run& run : state_.ended) {
    if (run.spatial_class > kHighest) return false;
  }
  return state_.current.spatial_class <= kHighest;
}

}  // namespace clew::classify

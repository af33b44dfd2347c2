// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/random.hpp"

namespace clew::trap_worlds {

/// Numbers one after the other, a function of a world's seed, family, number and attempt.
class Dice {
 public:
  explicit Dice(const core::RandomKey& key) : random_(key) {}

  double between(double low, double high) { return low + (high - low) * random_.uniform(next_++); }
  /// A whole number, both ends included.
  int count(int low, int high) {
    return low + static_cast<int>(random_.uniform(next_++) * static_cast<double>(high - low + 1));
  }
  bool coin() { return random_.uniform(next_++) < 0.5; }

 private:
  core::Random random_;
  std::uint32_t next_ = 0;
};

}  // namespace clew::trap_worlds

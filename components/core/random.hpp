// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace clew::core {

/// What a random number is a function of: the same key and index give the same number, in any
/// process, after any restart.
struct RandomKey {
  std::uint64_t seed = 1;
  std::uint32_t robot = 0;
  std::uint32_t component = 0;
  std::uint64_t tick = 0;
};

/// Counter-based random numbers: Philox 4x32-10 (Salmon et al. 2011, "Parallel random numbers: as
/// easy as 1, 2, 3", section 4.2). There is no state to save: number i of a key is computed alone.
class Random {
 public:
  explicit Random(const RandomKey& key) : key_(key) {}

  /// 64 random bits: the index-th of this key.
  std::uint64_t bits(std::uint32_t index) const;
  /// Uniform in [0, 1), a multiple of 2^-53.
  double uniform(std::uint32_t index) const;
  /// Normal with mean 0 and standard deviation 1 (Box and Muller 1958).
  double normal(std::uint32_t index) const;

 private:
  RandomKey key_;
};

/// Philox 4x32-10 itself, for its published test vectors.
std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> counter,
                                        std::array<std::uint32_t, 2> key);

}  // namespace clew::core

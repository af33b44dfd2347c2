// SPDX-License-Identifier: Apache-2.0
#include "core/random.hpp"

#include <cmath>

#include "core/math.hpp"

namespace clew::core {

std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> counter,
                                        std::array<std::uint32_t, 2> key) {
  constexpr std::uint64_t kMultiplier0 = 0xD2511F53;
  constexpr std::uint64_t kMultiplier1 = 0xCD9E8D57;
  constexpr std::uint32_t kWeyl0 = 0x9E3779B9;
  constexpr std::uint32_t kWeyl1 = 0xBB67AE85;
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t product0 = kMultiplier0 * counter[0];
    const std::uint64_t product1 = kMultiplier1 * counter[2];
    counter = {static_cast<std::uint32_t>(product1 >> 32) ^ counter[1] ^ key[0],
               static_cast<std::uint32_t>(product1),
               static_cast<std::uint32_t>(product0 >> 32) ^ counter[3] ^ key[1],
               static_cast<std::uint32_t>(product0)};
    key[0] += kWeyl0;
    key[1] += kWeyl1;
  }
  return counter;
}

std::uint64_t Random::bits(std::uint32_t index) const {
  // The tick fills two words of the counter, the index one, robot and component share the last.
  const std::uint32_t who = (key_.robot << 16) ^ key_.component;
  const auto words = philox4x32(
      {static_cast<std::uint32_t>(key_.tick), static_cast<std::uint32_t>(key_.tick >> 32), index,
       who},
      {static_cast<std::uint32_t>(key_.seed), static_cast<std::uint32_t>(key_.seed >> 32)});
  return (static_cast<std::uint64_t>(words[1]) << 32) | words[0];
}

double Random::uniform(std::uint32_t index) const {
  return static_cast<double>(bits(index) >> 11) * 0x1p-53;
}

double Random::normal(std::uint32_t index) const {
  const std::uint64_t word = bits(index);
  // Two uniforms of 32 bits from one word; the first is never 0, so that its logarithm is finite.
  const double radius_uniform = (static_cast<double>(word >> 32) + 1.0) * 0x1p-32;
  const double angle_uniform = static_cast<double>(word & 0xFFFFFFFFu) * 0x1p-32;
  return std::sqrt(-2.0 * log(radius_uniform)) * cos(2.0 * kPi * angle_uniform);
}

}  // namespace clew::core

// SPDX-License-Identifier: Apache-2.0
#include "core/hash128.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <cstdio>
#include <cstring>

namespace clew::core {

std::string Hash128::hex() const {
  char text[33];
  std::snprintf(text, sizeof text, "%016llx%016llx", static_cast<unsigned long long>(high),
                static_cast<unsigned long long>(low));
  return text;
}

Hash128 hash128(std::string_view bytes) {
  const XXH128_hash_t h = XXH3_128bits(bytes.data(), bytes.size());
  return {h.high64, h.low64};
}

void HashChain::add(std::uint64_t tick, std::uint64_t sequence, std::string_view bytes) {
  // The sample's own hash first, then one fixed block: no sample needs copying.
  const Hash128 content = hash128(bytes);
  const std::uint64_t block[] = {value_.high,  value_.low,   tick,       sequence,
                                 bytes.size(), content.high, content.low};
  char raw[sizeof block];
  std::memcpy(raw, block, sizeof block);
  value_ = hash128({raw, sizeof raw});
}

}  // namespace clew::core

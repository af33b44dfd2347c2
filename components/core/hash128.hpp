// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace clew::core {

/// A 128-bit hash (XXH3 of xxHash). It finds accidental differences; it is no cryptographic one.
struct Hash128 {
  std::uint64_t high = 0;
  std::uint64_t low = 0;

  /// 32 hexadecimal digits.
  std::string hex() const;
};

template <typename Visitor>
void visit_fields(Visitor& visit, Hash128& h) {
  visit(h.high, h.low);
}

inline bool operator==(const Hash128& a, const Hash128& b) {
  return a.high == b.high && a.low == b.low;
}
inline bool operator!=(const Hash128& a, const Hash128& b) { return !(a == b); }

Hash128 hash128(std::string_view bytes);

/// The chained hash over the samples of one topic: h' = H(h, tick, sequence, size, bytes), from 0.
class HashChain {
 public:
  void add(std::uint64_t tick, std::uint64_t sequence, std::string_view bytes);
  const Hash128& value() const { return value_; }

  template <typename Visitor>
  friend void visit_fields(Visitor& visit, HashChain& chain) {
    visit(chain.value_);
  }

 private:
  Hash128 value_;
};

}  // namespace clew::core

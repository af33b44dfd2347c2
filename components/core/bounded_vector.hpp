// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "core/check.hpp"

namespace clew::core {

/// Up to N values stored in place: a list on an arrow, which a step fills without allocating.
template <typename T, std::size_t N>
class BoundedVector {
 public:
  static constexpr std::size_t kCapacity = N;

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  bool full() const { return size_ == N; }
  void clear() { size_ = 0; }

  /// Appends a value; a full list is a mistake of the caller.
  void push_back(const T& value) {
    CLEW_CHECK(size_ < N, "a list of at most " + std::to_string(N) + " values is full");
    items_[size_++] = value;
  }
  /// Sets the size, 0..N; new values are default ones.
  void resize(std::size_t size) {
    CLEW_CHECK(size <= N,
               std::to_string(size) + " values in a list of at most " + std::to_string(N));
    for (std::size_t i = size_; i < size; ++i) items_[i] = T{};
    size_ = size;
  }

  T& operator[](std::size_t i) { return items_[i]; }
  const T& operator[](std::size_t i) const { return items_[i]; }
  T* begin() { return items_.data(); }
  T* end() { return items_.data() + size_; }
  const T* begin() const { return items_.data(); }
  const T* end() const { return items_.data() + size_; }

 private:
  std::array<T, N> items_{};
  std::size_t size_ = 0;
};

template <typename T, std::size_t N>
bool operator==(const BoundedVector<T, N>& a, const BoundedVector<T, N>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!(a[i] == b[i])) return false;
  }
  return true;
}

}  // namespace clew::core

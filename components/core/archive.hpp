// SPDX-License-Identifier: Apache-2.0
/// Saving and loading the state of a behaviour. A state is a struct with one free function
///
///     template <typename Visitor> void visit_fields(Visitor& visit, MyState& s) {
///       visit(s.travel_m, s.queue, s.mode);
///     }
///
/// found by argument-dependent lookup. Fields may be arithmetic types, enums, strings, optionals,
/// pairs, arrays, vectors, deques, ordered maps and sets, BoundedVector, Eigen fixed vectors, and
/// structs with visit_fields of their own. The bytes are the same for the same state.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/bounded_vector.hpp"

namespace clew::core {

/// Appends fields to a byte string, little-endian, without padding.
class StateWriter {
 public:
  template <typename... Fields>
  void operator()(const Fields&... fields) {
    (put(fields), ...);
  }
  const std::string& bytes() const { return bytes_; }
  std::string take() { return std::move(bytes_); }

 private:
  template <typename T>
  void put(const T& v) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      char raw[sizeof(T)];
      std::memcpy(raw, &v, sizeof(T));
      bytes_.append(raw, sizeof(T));
    } else {
      // It takes its struct by reference to serve the reader, too; a writer changes nothing in it.
      visit_fields(*this, const_cast<T&>(v));
    }
  }
  void put_size(std::size_t n) { put(static_cast<std::uint64_t>(n)); }
  template <typename Range>
  void put_range(const Range& range) {
    put_size(range.size());
    for (const auto& item : range) put(item);
  }
  void put(const std::string& v) {
    put_size(v.size());
    bytes_ += v;
  }
  template <typename T>
  void put(const std::optional<T>& v) {
    put(v.has_value());
    if (v) put(*v);
  }
  template <typename A, typename B>
  void put(const std::pair<A, B>& v) {
    put(v.first);
    put(v.second);
  }
  template <typename T, std::size_t N>
  void put(const std::array<T, N>& v) {
    for (const T& item : v) put(item);
  }
  template <typename T, std::size_t N>
  void put(const BoundedVector<T, N>& v) {
    put_range(v);
  }
  void put(const std::vector<bool>& v) {
    put_size(v.size());
    for (bool item : v) put(item);
  }
  template <typename T>
  void put(const std::vector<T>& v) {
    put_range(v);
  }
  template <typename T>
  void put(const std::deque<T>& v) {
    put_range(v);
  }
  template <typename K, typename V>
  void put(const std::map<K, V>& v) {
    put_range(v);
  }
  template <typename T>
  void put(const std::set<T>& v) {
    put_range(v);
  }
  template <typename S, int R, int C>
  void put(const Eigen::Matrix<S, R, C>& v) {
    static_assert(R > 0 && C > 0, "only fixed sizes");
    for (int i = 0; i < R * C; ++i) put(v.data()[i]);
  }

  std::string bytes_;
};

/// Reads what a StateWriter wrote, in the same order. States come from files, too, and so from
/// strangers. After any shortage or nonsense ok() is false and the fields keep unspecified values
/// of their types, which must not be used: numbers that are none and booleans beyond 0 and 1 are
/// found here; what else a field may be (an index, an enumerator, a length) its owner asks with
/// check().
class StateReader {
 public:
  explicit StateReader(std::string_view bytes) : bytes_(bytes), total_bytes_(bytes.size()) {}

  template <typename... Fields>
  void operator()(Fields&... fields) {
    (get(fields), ...);
  }
  /// True while everything asked for was there.
  bool ok() const { return ok_; }
  /// True if, besides, nothing is left over.
  bool complete() const { return ok_ && bytes_.empty(); }

  /// Finds fault with what was read, unless `valid`: `why` says what is wrong. Returns ok().
  bool check(bool valid, const char* why) {
    if (ok_ && !valid) refuse(why);
    return ok_;
  }
  /// What is wrong, and before which byte: `'escape' is no escape, byte 8 of 312`.
  std::string fault() const {
    const bool left_over = ok_ && !bytes_.empty();
    return (left_over ? "it is too long" : why_) + ", byte " +
           std::to_string(ok_ ? total_bytes_ - bytes_.size() : fault_at_) + " of " +
           std::to_string(total_bytes_);
  }

 private:
  void refuse(const char* why) {
    if (ok_) {
      why_ = why;
      fault_at_ = total_bytes_ - bytes_.size();
    }
    ok_ = false;
  }
  template <typename T>
  void get(T& v) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      if (bytes_.size() < sizeof(T)) {
        refuse("it is too short");
        return;
      }
      if constexpr (std::is_same_v<T, bool>) {
        if (static_cast<unsigned char>(bytes_[0]) > 1) refuse("a flag is neither 0 nor 1");
        v = bytes_[0] != 0;
      } else {
        std::memcpy(&v, bytes_.data(), sizeof(T));
      }
      if constexpr (std::is_floating_point_v<T>) {
        if (std::isnan(v)) {
          refuse("a number is NaN");
          v = T{};
        }
      }
      bytes_.remove_prefix(sizeof(T));
    } else {
      visit_fields(*this, v);
    }
  }
  // Every item takes at least one byte, so a size beyond what is left is nonsense.
  std::size_t get_size() {
    std::uint64_t size = 0;
    get(size);
    if (size > bytes_.size()) {
      refuse("a list is longer than what is left");
      return 0;
    }
    return static_cast<std::size_t>(size);
  }
  void get(std::string& v) {
    const std::size_t n = get_size();
    v.assign(bytes_.substr(0, n));
    bytes_.remove_prefix(n);
  }
  template <typename T>
  void get(std::optional<T>& v) {
    bool present = false;
    get(present);
    v.reset();
    if (present && ok_) get(v.emplace());
  }
  template <typename A, typename B>
  void get(std::pair<A, B>& v) {
    get(v.first);
    get(v.second);
  }
  template <typename T, std::size_t N>
  void get(std::array<T, N>& v) {
    for (T& item : v) get(item);
  }
  template <typename T, std::size_t N>
  void get(BoundedVector<T, N>& v) {
    const std::size_t n = get_size();
    if (n > N) {
      refuse("a list has more than its room");
      return;
    }
    v.resize(n);
    for (T& item : v) get(item);
  }
  void get(std::vector<bool>& v) {
    v.assign(get_size(), false);
    for (std::size_t i = 0; i < v.size() && ok_; ++i) {
      bool item = false;
      get(item);
      v[i] = item;
    }
  }
  template <typename T>
  void get(std::vector<T>& v) {
    get_sequence(v);
  }
  template <typename T>
  void get(std::deque<T>& v) {
    get_sequence(v);
  }
  template <typename Sequence>
  void get_sequence(Sequence& v) {
    const std::size_t n = get_size();
    v.clear();
    for (std::size_t i = 0; i < n && ok_; ++i) get(v.emplace_back());
  }
  template <typename K, typename V>
  void get(std::map<K, V>& v) {
    const std::size_t n = get_size();
    v.clear();
    for (std::size_t i = 0; i < n && ok_; ++i) {
      std::pair<K, V> item{};
      get(item);
      v.emplace_hint(v.end(), std::move(item));
    }
  }
  template <typename T>
  void get(std::set<T>& v) {
    const std::size_t n = get_size();
    v.clear();
    for (std::size_t i = 0; i < n && ok_; ++i) {
      T item{};
      get(item);
      v.emplace_hint(v.end(), std::move(item));
    }
  }
  template <typename S, int R, int C>
  void get(Eigen::Matrix<S, R, C>& v) {
    for (int i = 0; i < R * C; ++i) get(v.data()[i]);
  }

  std::string_view bytes_;
  std::size_t total_bytes_;
  bool ok_ = true;
  std::string why_ = "it is too short";
  std::size_t fault_at_ = 0;
};

}  // namespace clew::core

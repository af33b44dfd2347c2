// SPDX-License-Identifier: Apache-2.0
/// XCDR1 of final structs without keys, little-endian (OMG DDS-XTypes 1.3, 7.4.1 and 7.4.2):
/// numbers are aligned to their size, counted from behind the encapsulation header; enumerators are
/// 32 bits, truth values a byte; a list or a text has its length in 32 bits in front, a text a zero
/// byte at its end that counts. Structs and arrays of a fixed length are their members one after
/// another.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>

#include "core/check.hpp"
#include "domain/message_fields.hpp"

namespace clew::bridge {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "bytes are copied as they are");

/// `00 01 00 00`: XCDR1, little-endian, no options.
inline constexpr char kCdrHeader[] = {'\x00', '\x01', '\x00', '\x00'};
inline constexpr std::size_t kCdrHeaderSize = sizeof kCdrHeader;

/// The type that stands for a value in CDR, if that is a single number.
template <typename Value>
using CdrNumber =
    std::conditional_t<std::is_enum_v<Value>, std::uint32_t,
                       std::conditional_t<std::is_same_v<Value, bool>, std::uint8_t, Value>>;

template <typename Value>
inline constexpr bool kIsCdrNumber = std::is_arithmetic_v<Value> || std::is_enum_v<Value>;

/// Whether many such values stand in CDR as they do in memory.
template <typename Value>
inline constexpr bool kIsSameInMemory = std::is_arithmetic_v<Value> && !std::is_same_v<Value, bool>;

/// How many bytes after `position` the next multiple of a power of two is.
template <std::size_t kAlignment>
constexpr std::size_t cdr_padding(std::size_t position) {
  static_assert((kAlignment & (kAlignment - 1)) == 0);
  return (~position + 1) & (kAlignment - 1);
}

/// Writes values one after another, zeros between them where they are aligned.
class CdrWriter {
 public:
  /// Writes to `bytes`, whose first one stands right behind the header. Values that have no place
  /// in `capacity` are a mistake of the caller.
  CdrWriter(char* bytes, std::size_t capacity) : bytes_(bytes), capacity_(capacity) {}

  std::size_t size() const { return size_; }

  template <typename Value>
  void write(const Value& value) {
    if constexpr (domain::kIsStruct<Value>) {
      domain::visit_named_fields([&](const char*, const auto& member) { write(member); }, value);
    } else if constexpr (domain::kIsSequence<Value>) {
      write(static_cast<std::uint32_t>(value.size()));
      write_items(value);
    } else if constexpr (domain::kIsArray<Value>) {
      write_items(value);
    } else {
      static_assert(kIsCdrNumber<Value>, "a type that CDR does not have");
      const auto number = static_cast<CdrNumber<Value>>(value);
      write_bytes<sizeof number>(&number, sizeof number);
    }
  }
  void write(const std::string& text) {
    write(static_cast<std::uint32_t>(text.size() + 1));
    write_bytes<1>(text.c_str(), text.size() + 1);
  }

 private:
  template <typename List>
  void write_items(const List& items) {
    using Item = std::decay_t<decltype(items[0])>;
    if constexpr (kIsSameInMemory<Item>) {
      if (items.size() > 0) write_bytes<sizeof(Item)>(&items[0], items.size() * sizeof(Item));
    } else {
      for (const Item& item : items) write(item);
    }
  }

  template <std::size_t kAlignment>
  void write_bytes(const void* from, std::size_t count) {
    const std::size_t padding = cdr_padding<kAlignment>(size_);
    CLEW_CHECK(padding + count <= capacity_ - size_, "a message longer than the longest");
    if (padding > 0) std::memset(bytes_ + size_, 0, padding);
    std::memcpy(bytes_ + size_ + padding, from, count);
    size_ += padding + count;
  }

  char* bytes_;
  std::size_t capacity_;
  std::size_t size_ = 0;
};

/// Adds up what values take at most.
class CdrBound {
 public:
  constexpr std::size_t size() const { return size_; }

  template <typename Value, typename Rule>
  constexpr void add(const Rule& rule) {
    if constexpr (domain::kIsStruct<Value>) {
      domain::for_each_field<Value>([&](const auto& field) {
        add<std::decay_t<decltype(std::declval<Value>().*field.member)>>(field.rule);
      });
    } else if constexpr (domain::kIsSequence<Value>) {
      add_bytes(4, 4);
      add_items<typename ItemOf<Value>::type>(domain::length_bound<Value>(rule),
                                              domain::item_rule(rule));
    } else if constexpr (domain::kIsArray<Value>) {
      add_items<typename Value::value_type>(std::tuple_size_v<Value>, rule);
    } else if constexpr (std::is_same_v<Value, std::string>) {
      add_bytes(4, 4);
      add_bytes(rule.bytes + 1, 1);
      alignment_ = 1;  // it may be shorter
    } else {
      add_bytes(sizeof(CdrNumber<Value>), sizeof(CdrNumber<Value>));
    }
  }

 private:
  template <typename List>
  struct ItemOf {
    using type = std::decay_t<decltype(std::declval<List>()[0])>;
  };

  template <typename Item, typename Rule>
  constexpr void add_items(std::size_t count, const Rule& rule) {
    for (std::size_t i = 0; i < count; ++i) add<Item>(rule);
  }

  constexpr void add_bytes(std::size_t count, std::size_t alignment) {
    if (alignment > alignment_) size_ += alignment - alignment_;  // or less
    const std::size_t reached = std::max(alignment, alignment_);
    size_ += count;
    alignment_ = reached;
    while (count % alignment_ != 0) alignment_ /= 2;
  }

  std::size_t size_ = 0;
  std::size_t alignment_ = 8;  ///< the place reached is a multiple of it
};

/// No message of this type has more bytes, header included.
template <typename Message>
constexpr std::size_t max_cdr_size() {
  CdrBound bound;
  bound.add<Message>(domain::ByType{});
  return kCdrHeaderSize + bound.size();
}

}  // namespace clew::bridge

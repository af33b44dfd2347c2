// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "domain/field_check.hpp"
#include "wire/cdr_writer.hpp"

namespace clew::bridge {

/// What becomes of an enumerator that has no place in a byte, as all of ours have.
enum class Enumerators { kMustFit, kCutTo255 };

/// Reads what CdrWriter writes from bytes that may hold anything. A length that cannot be ends the
/// reading; what is read then is not to be used. With domain::NoPath it says that something is
/// wrong, but not what.
template <typename Path>
class BasicCdrReader {
 public:
  /// The first of `bytes` stands right behind the header.
  BasicCdrReader(std::string_view bytes, Enumerators enumerators)
      : bytes_(bytes), enumerators_(enumerators) {}

  /// A struct's fields, each by its rule as far as that bounds its length.
  template <typename Struct>
  void read_struct(Struct& value, const Path* outer = nullptr) {
    domain::for_each_field<Struct>([&](const auto& field) {
      if (ok()) read(value.*field.member, field.rule, Path(outer, field.name));
    });
  }

  /// Whether the bytes had room for all values, and the message for all bytes.
  bool ok() const { return !fault_; }
  /// What is wrong, and with which field: if nothing is with lengths, the first value that is none
  /// of its type.
  const std::optional<std::string>& fault() const { return ok() ? value_fault_ : fault_; }
  /// How many bytes were read.
  std::size_t position() const { return position_; }

 private:
  template <typename Value, typename Rule>
  void read(Value& value, const Rule& rule, const Path& path) {
    if constexpr (domain::kIsStruct<Value>) {
      read_struct(value, &path);
    } else if constexpr (domain::kIsSequence<Value>) {
      read_sequence(value, rule, path);
    } else if constexpr (domain::kIsArray<Value>) {
      read_items(value, rule, path);
    } else if constexpr (std::is_same_v<Value, std::string>) {
      read_text(value, rule.bytes, path);
    } else {
      CdrNumber<Value> number{};
      read_bytes<sizeof number>(&number, sizeof number, path);
      assign(value, number, path);
    }
  }

  template <typename Number>
  void assign(Number& value, Number number, const Path&) {
    value = number;
  }
  void assign(bool& value, std::uint8_t number, const Path& path) {
    if (number > 1) refuse(path, number, "0 and 1");
    value = number != 0;
  }
  template <typename Enum>
  std::enable_if_t<std::is_enum_v<Enum>> assign(Enum& value, std::uint32_t number,
                                                const Path& path) {
    constexpr std::uint32_t kLargest = std::numeric_limits<std::underlying_type_t<Enum>>::max();
    if (number > kLargest && enumerators_ == Enumerators::kMustFit) {
      refuse(path, number, "at most " + std::to_string(domain::kEnumeratorNames<Enum>.size() - 1));
    }
    value = static_cast<Enum>(std::min(number, kLargest));
  }

  /// The length is held against its bound before anything is set aside for the items.
  template <typename List, typename Rule>
  void read_sequence(List& items, const Rule& rule, const Path& path) {
    using Item = std::decay_t<decltype(items[0])>;
    std::uint32_t length = 0;
    read_bytes<sizeof length>(&length, sizeof length, path);
    const std::size_t bound = domain::length_bound<List>(rule);
    if (length > bound) return fail_long(path, length, "values", bound);
    if constexpr (kIsSameInMemory<Item>) {
      if (length > (bytes_.size() - position_) / sizeof(Item)) return fail_short(path);
    }
    items.resize(length);
    read_items(items, domain::item_rule(rule), path);
  }

  template <typename List, typename Rule>
  void read_items(List& items, const Rule& rule, const Path& path) {
    using Item = std::decay_t<decltype(items[0])>;
    if constexpr (kIsSameInMemory<Item>) {
      if (items.size() > 0) {
        read_bytes<sizeof(Item)>(&items[0], items.size() * sizeof(Item), path);
      }
    } else {
      for (std::size_t i = 0; i < items.size() && ok(); ++i) read(items[i], rule, Path(path, i));
    }
  }

  void read_text(std::string& text, std::size_t bound, const Path& path);

  /// Copies `count` bytes from the next place that is a multiple of the alignment.
  template <std::size_t kAlignment>
  void read_bytes(void* to, std::size_t count, const Path& path) {
    const std::size_t padding = cdr_padding<kAlignment>(position_);
    const std::size_t left = bytes_.size() - position_;
    if (padding > left || count > left - padding) return fail_short(path);
    std::memcpy(to, bytes_.data() + position_ + padding, count);
    position_ += padding + count;
  }

  void fail_short(const Path& path);
  void fail_long(const Path& path, std::uint32_t found, const char* unit, std::size_t bound);
  void refuse(const Path& path, std::uint32_t found, const std::string& allowed);

  std::string_view bytes_;
  Enumerators enumerators_;
  std::size_t position_ = 0;
  std::optional<std::string> fault_;
  std::optional<std::string> value_fault_;
};

extern template class BasicCdrReader<domain::FieldPath>;
extern template class BasicCdrReader<domain::NoPath>;
using CdrReader = BasicCdrReader<domain::FieldPath>;

}  // namespace clew::bridge

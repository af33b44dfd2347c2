// SPDX-License-Identifier: Apache-2.0
/// Messages of ROS 2 to CDR bytes and back: XCDR1, as both rmw implementations write them.
#pragma once

#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "ros2/message_fields.hpp"
#include "wire/cdr_reader.hpp"
#include "wire/cdr_writer.hpp"

namespace clew::ros2 {

/// Adds up what values take in CDR.
class CdrSize {
 public:
  std::size_t size() const { return size_; }

  template <typename Value>
  void add(const Value& value) {
    if constexpr (domain::kIsStruct<Value>) {
      domain::visit_named_fields([&](const char*, const auto& member) { add(member); }, value);
    } else if constexpr (std::is_same_v<Value, std::string>) {
      add_bytes<4>(4);
      add_bytes<1>(value.size() + 1);
    } else if constexpr (domain::kIsSequence<Value> || domain::kIsArray<Value>) {
      if constexpr (domain::kIsSequence<Value>) add_bytes<4>(4);
      add_items(value);
    } else {
      add_bytes<sizeof(Value)>(sizeof(Value));
    }
  }

 private:
  template <typename List>
  void add_items(const List& items) {
    using Item = typename List::value_type;
    if constexpr (bridge::kIsSameInMemory<Item>) {
      if (!items.empty()) add_bytes<sizeof(Item)>(items.size() * sizeof(Item));
    } else {
      for (const Item& item : items) add(item);
    }
  }
  template <std::size_t kAlignment>
  void add_bytes(std::size_t count) {
    size_ += bridge::cdr_padding<kAlignment>(size_) + count;
  }

  std::size_t size_ = 0;
};

/// The bytes of a message with their header, in `buffer`.
template <typename Message>
std::string_view encode(const Message& message, std::vector<char>& buffer) {
  CdrSize content;
  content.add(message);
  buffer.resize(bridge::kCdrHeaderSize + content.size());
  std::memcpy(buffer.data(), bridge::kCdrHeader, bridge::kCdrHeaderSize);
  bridge::CdrWriter writer(buffer.data() + bridge::kCdrHeaderSize, content.size());
  writer.write(message);
  return {buffer.data(), buffer.size()};
}

/// Fills `message` from bytes that came from outside. Refused: another encapsulation than XCDR1,
/// little-endian, and bytes that are too short, too long, or no message of this type. Numbers may
/// be any, NaN too.
template <typename Message>
core::Result<void> decode(std::string_view cdr, Message& message) {
  constexpr std::size_t kMostPadding = 3;
  const auto refuse = [](const std::string& why) {
    return core::Error{std::string(kTypeName<Message>) + ": " + why};
  };
  message = {};
  if (cdr.size() < bridge::kCdrHeaderSize || cdr[0] != bridge::kCdrHeader[0] ||
      cdr[1] != bridge::kCdrHeader[1]) {
    return refuse("not in XCDR1, little-endian");
  }
  cdr.remove_prefix(bridge::kCdrHeaderSize);
  bridge::CdrReader reader(cdr, bridge::Enumerators::kMustFit);
  reader.read_struct(message);
  if (reader.fault()) return refuse(*reader.fault());
  if (cdr.size() - reader.position() > kMostPadding) return refuse("longer than its content");
  return {};
}

}  // namespace clew::ros2

// SPDX-License-Identifier: Apache-2.0
/// What ROS says of a message's type: its names, its definition, its hash.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

#include "ros2/message_fields.hpp"

namespace clew::ros2 {

/// A field as a type description has it (rosidl, type_description_interfaces/msg/FieldType).
struct FieldDescription {
  std::string name;
  std::uint8_t type_id = 0;
  std::uint64_t capacity = 0;         ///< of an array
  std::uint64_t string_capacity = 0;  ///< of a bounded text
  std::string nested_type;            ///< `geometry_msgs/msg/Point`; empty for a basic type
  std::string definition_type;        ///< as in a .msg file: `float64[36]`
};

/// A message's fields, and those of all messages in it, by name.
struct TypeDescription {
  std::string name;
  std::vector<FieldDescription> fields;
  std::map<std::string, std::vector<FieldDescription>> referenced;
};

/// All that is said of a type on the wire and in bags.
struct MessageType {
  std::string name;        ///< `sensor_msgs/msg/LaserScan`
  std::string dds_name;    ///< `sensor_msgs::msg::dds_::LaserScan_`
  std::string hash;        ///< `RIHS01_64c1...`
  std::string definition;  ///< text in the format ros2msg, with all messages in it
};

namespace describing {

// Numbers of type_description_interfaces/msg/FieldType.
inline constexpr std::uint8_t kNested = 1;
inline constexpr std::uint8_t kOctet = 16;
inline constexpr std::uint8_t kText = 17;
inline constexpr std::uint8_t kBoundedText = 21;
inline constexpr std::uint8_t kArray = 48;
inline constexpr std::uint8_t kUnboundedList = 144;

template <typename Value>
FieldDescription number_field() {
  if constexpr (std::is_same_v<Value, bool>) return {{}, 15, 0, 0, {}, "bool"};
  if constexpr (std::is_same_v<Value, std::int8_t>) return {{}, 2, 0, 0, {}, "int8"};
  if constexpr (std::is_same_v<Value, std::uint8_t>) return {{}, 3, 0, 0, {}, "uint8"};
  if constexpr (std::is_same_v<Value, std::int32_t>) return {{}, 6, 0, 0, {}, "int32"};
  if constexpr (std::is_same_v<Value, std::uint32_t>) return {{}, 7, 0, 0, {}, "uint32"};
  if constexpr (std::is_same_v<Value, float>) return {{}, 10, 0, 0, {}, "float32"};
  if constexpr (std::is_same_v<Value, double>) return {{}, 11, 0, 0, {}, "float64"};
}

/// `geometry_msgs/Point`, as .msg files name a message of another package.
std::string short_name(std::string_view type_name);

template <typename Struct>
void add_fields(std::vector<FieldDescription>& fields, TypeDescription& whole);

template <typename Value, typename Rule>
FieldDescription describe_value(const Rule& rule, TypeDescription& whole) {
  if constexpr (domain::kIsSequence<Value>) {
    FieldDescription field =
        describe_value<typename Value::value_type>(domain::item_rule(rule), whole);
    field.type_id = static_cast<std::uint8_t>(field.type_id + kUnboundedList);
    field.definition_type += "[]";
    return field;
  } else if constexpr (domain::kIsArray<Value>) {
    FieldDescription field = describe_value<typename Value::value_type>(rule, whole);
    field.type_id = static_cast<std::uint8_t>(field.type_id + kArray);
    field.capacity = std::tuple_size_v<Value>;
    field.definition_type += '[' + std::to_string(field.capacity) + ']';
    return field;
  } else if constexpr (domain::kIsStruct<Value>) {
    const std::string name(kTypeName<Value>);
    if (whole.referenced.count(name) == 0) {
      std::vector<FieldDescription> fields;
      add_fields<Value>(fields, whole);
      whole.referenced[name] = std::move(fields);
    }
    return {{}, kNested, 0, 0, name, short_name(name)};
  } else if constexpr (std::is_same_v<Rule, domain::TextUpTo>) {
    return {{}, kBoundedText, 0, rule.bytes, {}, "string<=" + std::to_string(rule.bytes)};
  } else if constexpr (std::is_same_v<Value, std::string>) {
    return {{}, kText, 0, 0, {}, "string"};
  } else if constexpr (std::is_same_v<Rule, Octet>) {
    return {{}, kOctet, 0, 0, {}, "byte"};
  } else {
    return number_field<Value>();
  }
}

template <typename Struct>
void add_fields(std::vector<FieldDescription>& fields, TypeDescription& whole) {
  domain::for_each_field<Struct>([&](const auto& field) {
    using Value = std::decay_t<decltype(std::declval<Struct>().*field.member)>;
    FieldDescription described = describe_value<Value>(field.rule, whole);
    described.name = field.name;
    fields.push_back(std::move(described));
  });
}

}  // namespace describing

template <typename Message>
TypeDescription describe_type() {
  TypeDescription whole;
  whole.name = kTypeName<Message>;
  describing::add_fields<Message>(whole.fields, whole);
  return whole;
}

/// The JSON over which a type's hash is taken: REP 2016, "ROS Interface Hashing Standard", as
/// rosidl_generator_type_description writes it.
std::string canonical_json(const TypeDescription& type);

MessageType message_type_of(const TypeDescription& type);

/// The type of a message, worked out once.
template <typename Message>
const MessageType& message_type() {
  static const MessageType kType = message_type_of(describe_type<Message>());
  return kType;
}

}  // namespace clew::ros2

// SPDX-License-Identifier: Apache-2.0
/// Samples whose type was another when they were recorded: read by the IDL text that they came
/// with.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "domain/topics.hpp"

namespace clew::bridge {

/// What an IDL text declares, as far as idl/ goes: modules, final structs, enumerations, numbers,
/// bounded texts, sequences and arrays.
class IdlTypes;

/// A topic's type as another version of idl/ declared it. Fields are known by their names: one that
/// has come since has its default value, one that is gone is passed over, and enumerators keep
/// their names.
class OlderType {
 public:
  /// Refused: a text that declares no struct of the topic's name, and what idl/ cannot have.
  static core::Result<OlderType> parse(domain::Topic topic, std::string_view idl);

  /// The same message as this version writes it, in `buffer`, valid until that is used again.
  /// Refused: bytes that do not fit the older type, and lists or texts that this version's bounds
  /// do not hold. Values are not looked at, as with Values::kAny.
  core::Result<std::string_view> to_current(std::string_view cdr, std::vector<char>& buffer) const;

  /// Whether the older type has the field of this path, such as `motion.kind` or `entries[2].x_m`.
  bool has_field(std::string_view path) const;

 private:
  OlderType(domain::Topic topic, std::shared_ptr<const IdlTypes> types, std::size_t root)
      : topic_(topic), types_(std::move(types)), root_(root) {}

  domain::Topic topic_;
  std::shared_ptr<const IdlTypes> types_;
  std::size_t root_;  ///< the topic's struct
};

}  // namespace clew::bridge

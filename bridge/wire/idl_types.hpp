// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"

namespace clew::bridge {

/// A member's type. Sequences and arrays are of what `kind` and `size` or `index` say.
struct IdlType {
  enum class Kind : std::uint8_t { kBoolean, kUnsigned, kDouble, kText, kEnumeration, kStruct };
  enum class List : std::uint8_t { kNone, kSequence, kArray };

  Kind kind = Kind::kBoolean;
  std::size_t size = 1;   ///< of a number, in bytes
  std::size_t index = 0;  ///< of a struct or an enumeration
  List list = List::kNone;
  std::uint32_t items = 0;  ///< of an array
};

class IdlTypes {
 public:
  struct Member {
    std::string name;
    IdlType type;
  };
  struct Struct {
    std::string name;
    std::vector<Member> members;  ///< at least one
    std::size_t depth = 1;        ///< of structs within structs
  };
  struct Enumeration {
    std::string name;
    std::vector<std::string> enumerators;
  };

  static core::Result<IdlTypes> parse(std::string_view idl);

  const std::vector<Struct>& structs() const { return structs_; }
  const std::vector<Enumeration>& enumerations() const { return enumerations_; }

 private:
  friend class IdlParser;
  std::vector<Struct> structs_;
  std::vector<Enumeration> enumerations_;
};

}  // namespace clew::bridge

// SPDX-License-Identifier: Apache-2.0
#include "wire/idl_types.hpp"

#include <algorithm>
#include <cctype>
#include <functional>
#include <map>

namespace clew::bridge {
namespace {

using core::Error;
using core::Result;

// Far beyond what idl/ has; a stranger's text costs no more.
constexpr std::size_t kMostBytes = 1024 * 1024;
constexpr std::size_t kMostDepth = 16;
constexpr std::uint32_t kMostItems = 1U << 20U;

/// Names and numbers as words, every other character as a word of its own; comments are none.
std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  for (std::size_t i = 0; i < text.size();) {
    const auto is_part = [&](std::size_t at) {
      return at < text.size() &&
             (std::isalnum(static_cast<unsigned char>(text[at])) != 0 || text[at] == '_');
    };
    if (text.substr(i, 2) == "//") {
      i = std::min(text.find('\n', i), text.size());
    } else if (std::isspace(static_cast<unsigned char>(text[i])) != 0) {
      ++i;
    } else {
      std::size_t end = i + 1;
      while (is_part(i) && is_part(end)) ++end;
      words.push_back(text.substr(i, end - i));
      i = end;
    }
  }
  return words;
}

}  // namespace

/// Reads the words of an IDL text, one after the other.
class IdlParser {
 public:
  explicit IdlParser(std::string_view idl) : words_(words_of(idl)) {}

  Result<IdlTypes> parse() {
    while (next_ < words_.size()) {
      CLEW_RETURN_IF_ERROR(parse_declaration());
    }
    if (depth_ != 0) return Error{"a module of it does not end"};
    return std::move(types_);
  }

 private:
  std::string_view word() const { return next_ < words_.size() ? words_[next_] : ""; }
  std::string_view take() { return next_ < words_.size() ? words_[next_++] : ""; }
  bool take_if(std::string_view wanted) {
    if (word() != wanted) return false;
    ++next_;
    return true;
  }
  Error unexpected(const std::string& expected) const {
    const std::string found = word().empty() ? "its end" : "'" + std::string(word()) + "'";
    return {"found " + found + ", expected " + expected};
  }
  Result<void> expect(std::string_view wanted) {
    if (take_if(wanted)) return {};
    return unexpected("'" + std::string(wanted) + "'");
  }
  Result<std::string> take_name() {
    if (word().empty() || std::isalpha(static_cast<unsigned char>(word()[0])) == 0) {
      return unexpected("a name");
    }
    return std::string(take());
  }
  Result<std::uint32_t> take_count() {
    std::uint32_t count = 0;
    if (word().empty()) return unexpected("a number");
    for (const char c : word()) {
      if (c < '0' || c > '9' || count > kMostItems) return unexpected("a number");
      count = 10 * count + static_cast<std::uint32_t>(c - '0');
    }
    if (count == 0 || count > kMostItems) return unexpected("a number from 1");
    ++next_;
    return count;
  }

  Result<void> parse_declaration() {
    if (take_if("module")) {
      const auto name = take_name();
      if (!name.ok()) return name.error();
      ++depth_;
      return expect("{");
    }
    if (depth_ > 0 && take_if("}")) {
      --depth_;
      return expect(";");
    }
    if (take_if("enum")) return parse_enumeration();
    CLEW_RETURN_IF_ERROR(expect("@"));
    CLEW_RETURN_IF_ERROR(expect("final"));
    CLEW_RETURN_IF_ERROR(expect("struct"));
    return parse_struct();
  }

  Result<void> parse_enumeration() {
    auto name = take_name();
    if (!name.ok()) return name.error();
    IdlTypes::Enumeration enumeration{*std::move(name), {}};
    CLEW_RETURN_IF_ERROR(expect("{"));
    do {
      auto enumerator = take_name();
      if (!enumerator.ok()) return enumerator.error();
      enumeration.enumerators.push_back(*std::move(enumerator));
    } while (take_if(","));
    enumeration_of_.emplace(enumeration.name, types_.enumerations_.size());
    types_.enumerations_.push_back(std::move(enumeration));
    CLEW_RETURN_IF_ERROR(expect("}"));
    return expect(";");
  }

  Result<void> parse_struct() {
    auto name = take_name();
    if (!name.ok()) return name.error();
    IdlTypes::Struct declared{*std::move(name), {}, 1};
    CLEW_RETURN_IF_ERROR(expect("{"));
    do {
      auto type = parse_type();
      if (!type.ok()) return type.error();
      auto member = take_name();
      if (!member.ok()) return member.error();
      if (take_if("[")) {
        if (type->list != IdlType::List::kNone) return unexpected("no array of sequences");
        const auto items = take_count();
        if (!items.ok()) return items.error();
        type->list = IdlType::List::kArray;
        type->items = *items;
        CLEW_RETURN_IF_ERROR(expect("]"));
      }
      CLEW_RETURN_IF_ERROR(expect(";"));
      if (type->kind == IdlType::Kind::kStruct) {
        declared.depth = std::max(declared.depth, types_.structs_[type->index].depth + 1);
      }
      declared.members.push_back({*std::move(member), *type});
    } while (word() != "}");
    if (declared.depth > kMostDepth) return Error{"its structs lie too deep within each other"};
    struct_of_.emplace(declared.name, types_.structs_.size());
    types_.structs_.push_back(std::move(declared));
    CLEW_RETURN_IF_ERROR(expect("}"));
    return expect(";");
  }

  Result<IdlType> parse_type() {
    if (!take_if("sequence")) return parse_item_type();
    CLEW_RETURN_IF_ERROR(expect("<"));
    auto type = parse_item_type();
    if (!type.ok()) return type.error();
    CLEW_RETURN_IF_ERROR(expect(","));
    const auto bound = take_count();
    if (!bound.ok()) return bound.error();
    CLEW_RETURN_IF_ERROR(expect(">"));
    type->list = IdlType::List::kSequence;
    return type;
  }

  Result<IdlType> parse_item_type() {
    if (take_if("boolean")) return IdlType{};
    if (take_if("double")) return IdlType{IdlType::Kind::kDouble, 8};
    for (const std::size_t size : {1U, 2U, 4U, 8U}) {
      if (take_if("uint" + std::to_string(8 * size)))
        return IdlType{IdlType::Kind::kUnsigned, size};
    }
    if (take_if("string")) {
      CLEW_RETURN_IF_ERROR(expect("<"));
      const auto bound = take_count();
      if (!bound.ok()) return bound.error();
      CLEW_RETURN_IF_ERROR(expect(">"));
      return IdlType{IdlType::Kind::kText, 1};
    }
    return parse_declared_type();
  }

  Result<IdlType> parse_declared_type() {
    const auto in_structs = struct_of_.find(word());
    const auto in_enumerations = enumeration_of_.find(word());
    if (in_structs != struct_of_.end()) {
      ++next_;
      return IdlType{IdlType::Kind::kStruct, 0, in_structs->second};
    }
    if (in_enumerations == enumeration_of_.end()) return unexpected("a type");
    ++next_;
    return IdlType{IdlType::Kind::kEnumeration, 4, in_enumerations->second};
  }

  std::vector<std::string_view> words_;
  std::size_t next_ = 0;
  std::size_t depth_ = 0;
  IdlTypes types_;
  /// By name; of several with one name the first counts.
  std::map<std::string, std::size_t, std::less<>> struct_of_;
  std::map<std::string, std::size_t, std::less<>> enumeration_of_;
};

Result<IdlTypes> IdlTypes::parse(std::string_view idl) {
  if (idl.size() > kMostBytes) return Error{"it is longer than any of ours"};
  return IdlParser(idl).parse();
}

}  // namespace clew::bridge

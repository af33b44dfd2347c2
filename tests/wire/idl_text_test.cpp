// SPDX-License-Identifier: Apache-2.0
/// The lists of fields in components/domain say what idl/ says: idl/ is the source.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include "core/math.hpp"
#include "domain/message_fields.hpp"
#include "tests/source_path.hpp"
#include "wire/codec.hpp"

namespace clew::bridge {
namespace {

using Words = std::vector<std::string>;

/// Names and numbers as words, every other character but space as a word of its own.
Words words_of(std::string_view text) {
  Words words;
  bool in_word = false;
  for (const char c : text) {
    const bool continues = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
    if (std::isspace(static_cast<unsigned char>(c)) == 0) {
      if (continues && in_word) {
        words.back() += c;
      } else {
        words.emplace_back(1, c);
      }
    }
    in_word = continues;
  }
  return words;
}

/// A struct's members as idl/ declares them: `sequence<double,8>`, `uint8[3]` and a name.
struct IdlMember {
  std::string type;
  std::string name;
};

/// What an IDL text declares.
struct IdlTypes {
  std::map<std::string, std::vector<IdlMember>> structs;
  std::map<std::string, Words> enumerations;
};

IdlMember parse_member(const Words& words) {
  std::size_t name = words.size() - 1;
  IdlMember member;
  if (words.back() == "]") {
    name = words.size() - 4;
    member.type = '[' + words[name + 2] + ']';
  }
  member.name = words[name];
  std::string type;
  for (std::size_t i = 0; i < name; ++i) type += words[i];
  member.type = type + member.type;
  return member;
}

IdlTypes parse(std::string_view text) {
  const Words words = words_of(text);
  IdlTypes types;
  for (std::size_t i = 0; i + 2 < words.size(); ++i) {
    if (words[i] == "enum") {
      Words& names = types.enumerations[words[i + 1]];
      for (std::size_t j = i + 3; words[j] != "}"; ++j) {
        if (words[j] != ",") names.push_back(words[j]);
      }
    } else if (words[i] == "struct") {
      EXPECT_TRUE(i > 1 && words[i - 2] == "@" && words[i - 1] == "final") << words[i + 1];
      auto& members = types.structs[words[i + 1]];
      Words declaration;
      for (std::size_t j = i + 3; words[j] != "}"; ++j) {
        if (words[j] != ";") {
          declaration.push_back(words[j]);
        } else {
          members.push_back(parse_member(declaration));
          declaration.clear();
        }
      }
    }
  }
  return types;
}

template <typename Struct>
void expect_same_struct(const IdlTypes& idl, const std::string& name);

/// Compares what a value is with what idl/ declares it to be.
template <typename Value, typename Rule>
void expect_same_type(const IdlTypes& idl, const std::string& type, const Rule& rule,
                      const std::string& where) {
  if constexpr (domain::kIsStruct<Value>) {
    expect_same_struct<Value>(idl, type);
  } else if constexpr (domain::kIsSequence<Value>) {
    using Item = std::decay_t<decltype(std::declval<Value>()[0])>;
    const std::string end = ',' + std::to_string(domain::length_bound<Value>(rule)) + '>';
    ASSERT_EQ(type.substr(0, 9), "sequence<") << where;
    ASSERT_EQ(type.substr(std::max(type.size(), end.size()) - end.size()), end) << where;
    expect_same_type<Item>(idl, type.substr(9, type.size() - 9 - end.size()),
                           domain::item_rule(rule), where);
  } else if constexpr (domain::kIsArray<Value>) {
    const std::string end = '[' + std::to_string(std::tuple_size_v<Value>) + ']';
    ASSERT_EQ(type.substr(std::max(type.size(), end.size()) - end.size()), end) << where;
    expect_same_type<typename Value::value_type>(idl, type.substr(0, type.size() - end.size()),
                                                 rule, where);
  } else if constexpr (std::is_enum_v<Value>) {
    const auto& names = domain::kEnumeratorNames<Value>;
    ASSERT_EQ(idl.enumerations.count(type), 1U) << where << ": " << type;
    EXPECT_EQ(Words(names.begin(), names.end()), idl.enumerations.at(type)) << where;
  } else if constexpr (std::is_same_v<Value, std::string>) {
    EXPECT_EQ("string<" + std::to_string(rule.bytes) + '>', type) << where;
  } else if constexpr (std::is_same_v<Value, bool>) {
    EXPECT_EQ(type, "boolean") << where;
  } else if constexpr (std::is_same_v<Value, double>) {
    EXPECT_EQ(type, "double") << where;
  } else {
    static_assert(std::is_unsigned_v<Value>);
    EXPECT_EQ("uint" + std::to_string(8 * sizeof(Value)), type) << where;
  }
}

template <typename Struct>
void expect_same_struct(const IdlTypes& idl, const std::string& name) {
  const auto found = idl.structs.find(name);
  ASSERT_NE(found, idl.structs.end()) << name;
  const std::vector<IdlMember>& declared = found->second;
  std::size_t count = 0;
  domain::for_each_field<Struct>([&](const auto& field) {
    const std::string where = name + '.' + field.name;
    ASSERT_LT(count, declared.size()) << where;
    const IdlMember& member = declared[count++];
    EXPECT_EQ(member.name, field.name) << name;
    using Value = std::decay_t<decltype(std::declval<Struct>().*field.member)>;
    expect_same_type<Value>(idl, member.type, field.rule, where);
  });
  EXPECT_EQ(count, declared.size()) << name << " has more members in idl/";
}

TEST(IdlText, DeclaresTheFieldsOfEveryMessageTheirOrderTheirTypesAndTheirBounds) {
  for (const domain::Topic topic : domain::kAllTopics) {
    domain::visit_topic(topic, [&](auto constant) {
      const std::string type(domain::type_name(topic));
      expect_same_struct<typename decltype(constant)::Message>(parse(idl_text(topic)),
                                                               type.substr(type.rfind(':') + 1));
    });
  }
}

/// What a comment says behind `[@range `: `0, 8`, `0, inf)` or `(-pi, pi]`; empty if nothing.
std::string range_in(const std::string& line) {
  const std::string tag = "[@range ";
  const std::size_t begin = line.find(tag);
  if (begin == std::string::npos) return "";
  const std::string text = line.substr(begin + tag.size());
  const std::size_t end = text.find_first_of(")]");
  const bool closes_tag = text[end] == ']' && text[0] != '(';
  return text.substr(0, closes_tag ? end : end + 1);
}

/// What the comments in idl/ say of values, by `Struct.member`.
std::map<std::string, std::string> ranges_in_idl() {
  static const std::regex kStruct(R"(^struct (\w+) \{)");
  static const std::regex kMember(R"((\w+)(\[\d+\])?;\s*//)");
  std::map<std::string, std::string> ranges;
  for (const auto& entry : std::filesystem::directory_iterator(tests::source_path("idl"))) {
    if (entry.path().extension() != ".idl") continue;
    std::ifstream file(entry.path());
    std::string current;
    for (std::string line; std::getline(file, line);) {
      std::smatch match;
      if (std::regex_search(line, match, kStruct)) current = match[1];
      if (!std::regex_search(line, match, kMember)) continue;
      ranges[current + '.' + match[1].str()] = range_in(line);
    }
  }
  return ranges;
}

/// `2 pi`, `-pi` or `8`.
std::string in_pi(double value) {
  const double turns = value / core::kPi;
  if (value == 0.0 || turns != std::floor(turns)) return fmt::format("{}", value);
  const std::string sign = turns < 0.0 ? "-" : "";
  const double times = std::fabs(turns);
  return sign + (times == 1.0 ? "" : fmt::format("{} ", times)) + "pi";
}

std::string range_text(domain::ByType) { return ""; }
std::string range_text(domain::NotNegative) { return "0, inf)"; }
std::string range_text(domain::WrappedAngle) { return "(-pi, pi]"; }
std::string range_text(const domain::InRange& rule) {
  return in_pi(rule.low) + ", " + in_pi(rule.high);
}
std::string range_text(const domain::AtMost& rule) { return fmt::format("0, {}", rule.last); }
std::string range_text(const domain::TextUpTo&) { return ""; }
template <typename ItemRule>
std::string range_text(const domain::ListUpTo<ItemRule>& rule) {
  return range_text(rule.item);
}

template <typename Value, typename = void>
constexpr bool kIsListOfStructs = false;
template <typename Value>
constexpr bool kIsListOfStructs<Value, std::enable_if_t<domain::kIsSequence<Value>>> =
    domain::kIsStruct<std::decay_t<decltype(std::declval<Value>()[0])>>;

/// Compares the rules of a struct's fields with the comments, but for those that depend on others.
template <typename Struct>
void expect_same_ranges(const std::map<std::string, std::string>& ranges, const IdlTypes& idl,
                        const std::string& name) {
  std::size_t count = 0;
  domain::for_each_field<Struct>([&](const auto& field) {
    using Value = std::decay_t<decltype(std::declval<Struct>().*field.member)>;
    using Rule = std::decay_t<decltype(domain::item_rule(field.rule))>;
    const std::string type = idl.structs.at(name).at(count++).type;
    if constexpr (domain::kIsStruct<Value>) {
      expect_same_ranges<Value>(ranges, idl, type);
    } else if constexpr (kIsListOfStructs<Value>) {
      const std::size_t begin = type.find('<') + 1;
      expect_same_ranges<std::decay_t<decltype(std::declval<Value>()[0])>>(
          ranges, idl, type.substr(begin, type.find(',') - begin));
    } else if constexpr (!std::is_same_v<Rule, domain::WithOthers>) {
      const std::string where = name + '.' + field.name;
      EXPECT_EQ(range_text(field.rule), ranges.at(where)) << where;
    }
  });
}

TEST(IdlText, HasTheRangesOfTheFieldsInItsComments) {
  const auto ranges = ranges_in_idl();

  for (const domain::Topic topic : domain::kAllTopics) {
    domain::visit_topic(topic, [&](auto constant) {
      const std::string type(domain::type_name(topic));
      expect_same_ranges<typename decltype(constant)::Message>(ranges, parse(idl_text(topic)),
                                                               type.substr(type.rfind(':') + 1));
    });
  }
  EXPECT_EQ(ranges.at("Scan.bearing_step_rad"), "-2 pi, 2 pi");
  EXPECT_EQ(ranges.at("Scan.ranges_m"), "0, range_max_m");
  EXPECT_EQ(ranges.at("TickMotion.turn_rad"), "-pi, pi");
}

TEST(IdlText, IsReadAsItIsWritten) {
  const IdlTypes types = parse(
      "module a { enum Kind { KIND_A, KIND_B }; @final struct S { Kind kind; uint8 classes[3];\n"
      "sequence<double, 8> bearings; string<48> rule; }; };");

  EXPECT_EQ(types.enumerations.at("Kind"), (Words{"KIND_A", "KIND_B"}));
  std::string members;
  for (const IdlMember& member : types.structs.at("S")) {
    members += member.type + ' ' + member.name + '\n';
  }
  EXPECT_EQ(members, "Kind kind\nuint8[3] classes\nsequence<double,8> bearings\nstring<48> rule\n");
}

TEST(IdlText, IsSelfContained) {
  for (const domain::Topic topic : domain::kAllTopics) {
    const std::string_view text = idl_text(topic);
    const std::string name(domain::type_name(topic).substr(std::string("clew::msg::").size()));

    EXPECT_NE(text.find("struct " + name + " {"), std::string_view::npos) << text;
    EXPECT_NE(text.find("struct TickStamp {"), std::string_view::npos) << text;
    EXPECT_EQ(text.find('#'), std::string_view::npos) << text;
  }
}

}  // namespace
}  // namespace clew::bridge

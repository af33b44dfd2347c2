// SPDX-License-Identifier: Apache-2.0
#include "wire/field_list.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>

#include "all_messages.hpp"
#include "domain/topics.hpp"
#include "message_json.hpp"
#include "random_messages.hpp"
#include "wire/codec.hpp"

namespace clew::bridge {
namespace {

using nlohmann::json;

constexpr unsigned kRandomMessages = 200;

/// The leaves of JSON that another function made of the message, with the names of idl/: lists are
/// preceded by their length, arrays of a fixed number of items (which `fixed` names) are not.
void flatten(const json& value, const std::string& path, std::map<std::string, json>& leaves) {
  static const std::set<std::string> fixed = {"classes", "run_lengths", "prototype_classes"};
  if (value.is_object()) {
    for (const auto& [name, member] : value.items()) {
      flatten(member, path.empty() ? name : path + '.' + name, leaves);
    }
  } else if (value.is_array()) {
    if (fixed.count(path.substr(path.rfind('.') + 1)) == 0) leaves[path + ".length"] = value.size();
    for (std::size_t i = 0; i < value.size(); ++i) {
      flatten(value[i], path + '[' + std::to_string(i) + ']', leaves);
    }
  } else {
    leaves[path] = value;
  }
}

/// What a field says, in the form of `like`. Enumerators, which are numbers there, are taken as
/// they are: a test of its own compares their names with the IDL's.
json as_json(const Field& field, const json& like) {
  if (std::holds_alternative<std::string_view>(field.value)) return like;
  if (const auto* number = std::get_if<std::uint64_t>(&field.value); number && like.is_string()) {
    return std::to_string(*number);
  }
  return std::visit([](const auto& value) { return json(value); }, field.value);
}

template <typename Message>
class FieldList : public testing::Test {};
TYPED_TEST_SUITE(FieldList, AllMessages);

TYPED_TEST(FieldList, AreAllThatTheMessageHasByTheirNamesInTheIdl) {
  RandomMessages random(1);
  for (unsigned i = 0; i < kRandomMessages; ++i) {
    TypeParam message;
    random.fill(message);
    std::map<std::string, json> expected;
    flatten(to_json(message), "", expected);

    const std::vector<Field> fields = fields_of(message);

    ASSERT_EQ(fields.size(), expected.size());
    for (const Field& field : fields) {
      ASSERT_TRUE(expected.count(field.path) == 1) << field.path;
      EXPECT_EQ(as_json(field, expected[field.path]), expected[field.path]) << field.path;
    }
  }
}

/// `entries.rule` for `entries[3].rule`.
std::string without_indices(std::string path) {
  for (std::size_t at = path.find('['); at != std::string::npos; at = path.find('[')) {
    path.erase(at, path.find(']') + 1 - at);
  }
  return path;
}

TYPED_TEST(FieldList, NamesTheFieldsThatAMessageCanHave) {
  RandomMessages random(2);
  std::set<std::string> seen;
  for (unsigned i = 0; i < kRandomMessages; ++i) {
    TypeParam message;
    random.fill(message);
    for (const Field& field : fields_of(message)) {
      const std::string path = without_indices(field.path);
      const std::size_t length = path.rfind(".length");
      if (length == std::string::npos || length + 7 != path.size()) seen.insert(path);
    }
  }

  const auto names = field_names(domain::topic_of<TypeParam>());

  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()), seen);
}

/// Changes the n-th value of a message by its last bit; an enumerator to the one before.
class BitFlipper {
 public:
  explicit BitFlipper(std::size_t place) : left_(place) {}

  template <typename Member>
  void operator()(const char*, Member& member) {
    change(member);
  }

 private:
  bool is_it() { return left_-- == 0; }

  template <typename Member>
  void change(Member& member) {
    if constexpr (std::is_same_v<Member, bool>) {
      if (is_it()) member = !member;
    } else if constexpr (std::is_same_v<Member, double>) {
      if (is_it()) member = member == 0.0 ? -member : std::nextafter(member, 0.0);
    } else if constexpr (std::is_enum_v<Member>) {
      const auto number = static_cast<unsigned>(member);
      if (is_it()) member = static_cast<Member>(number > 0 ? number - 1 : 1);
    } else if constexpr (std::is_integral_v<Member>) {
      if (is_it()) member = static_cast<Member>(member ^ 1U);
    } else if constexpr (std::is_same_v<Member, std::string>) {
      if (is_it() && !member.empty()) member.back() = static_cast<char>(member.back() ^ 1);
    } else {
      domain::visit_named_fields(*this, member);
    }
  }
  template <typename T, std::size_t N>
  void change(std::array<T, N>& items) {
    for (T& item : items) change(item);
  }
  template <typename T, std::size_t N>
  void change(core::BoundedVector<T, N>& items) {
    is_it();  // the length has a place, too
    for (T& item : items) change(item);
  }
  template <typename T>
  void change(std::vector<T>& items) {
    is_it();
    for (T& item : items) change(item);
  }

  std::size_t left_;
};

/// Every place, but of long lists a sample.
std::size_t next_place(std::size_t place) { return place < 64 ? place + 1 : place + 101; }

TYPED_TEST(FieldList, ShowAChangedBitInAnyOfThem) {
  RandomMessages random(2);
  for (unsigned i = 0; i < 20; ++i) {
    TypeParam message;
    random.fill(message);
    const std::vector<Field> fields = fields_of(message);
    for (std::size_t place = 0; place < fields.size(); place = next_place(place)) {
      const bool is_empty_text = std::get_if<std::string>(&fields[place].value) != nullptr &&
                                 std::get<std::string>(fields[place].value).empty();
      if (fields[place].path.find(".length") != std::string::npos || is_empty_text) continue;
      TypeParam changed = message;
      BitFlipper flipper(place);
      domain::visit_named_fields(flipper, changed);

      const auto found = differences(message, changed);

      ASSERT_EQ(found.size(), 1U) << fields[place].path;
      EXPECT_EQ(found[0].path, fields[place].path);
      EXPECT_TRUE(same_bits(*found[0].a, fields[place].value));
      EXPECT_NE(field_text(*found[0].a), field_text(*found[0].b)) << found[0].path;
    }
  }
}

TYPED_TEST(FieldList, AreEqualToThemselves) {
  RandomMessages random(3);
  TypeParam message;
  random.fill(message);

  EXPECT_TRUE(differences(message, message).empty());
}

TEST(FieldText, NamesEnumeratorsAndGivesTheNumberOfOneThatHasNoName) {
  domain::Command command;
  command.motion.kind = domain::CommandKind::kGiveUp;
  EXPECT_EQ(field_text(fields_of(command)[3].value), "COMMAND_GIVE_UP");

  command.motion.kind = static_cast<domain::CommandKind>(9);
  EXPECT_EQ(field_text(fields_of(command)[3].value), "9");
}

domain::Scan scan_of(std::vector<double> ranges_m) {
  domain::Scan scan;
  scan.ranges_m = std::move(ranges_m);
  return scan;
}

TEST(FieldDifferences, TellALongerListByItsLengthAndWhatTheOtherHasNot) {
  const auto found = differences(scan_of({1.0, 2.0}), scan_of({1.0, 2.0, 3.5}));

  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].path, "ranges_m.length");
  EXPECT_EQ(found[0].a, FieldValue(std::uint64_t{2}));
  EXPECT_EQ(found[0].b, FieldValue(std::uint64_t{3}));
  EXPECT_EQ(found[1].path, "ranges_m[2]");
  EXPECT_EQ(found[1].a, std::nullopt);
  EXPECT_EQ(found[1].b, FieldValue(3.5));
}

TEST(FieldDifferences, TellZeroFromMinusZero) {
  const auto found = differences(scan_of({0.0}), scan_of({-0.0}));

  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(field_text(*found[0].a), "0");
  EXPECT_EQ(field_text(*found[0].b), "-0");
}

TEST(FieldDifferences, FindNanEqualToItselfAndToldApartByItsBits) {
  const double nan = std::numeric_limits<double>::quiet_NaN();

  EXPECT_TRUE(differences(scan_of({nan}), scan_of({nan})).empty());
  const auto found = differences(scan_of({nan}), scan_of({std::nan("7")}));

  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(field_text(*found[0].a), "nan(0x7ff8000000000000)");
  EXPECT_EQ(field_text(*found[0].b), "nan(0x7ff8000000000007)");
}

TEST(FieldDifferences, PassOverNumbersWithinATolerance) {
  const domain::Scan a = scan_of({1.0, 2.0});
  const domain::Scan b = scan_of({1.0625, 2.25});

  EXPECT_EQ(differences(a, b, 0.25).size(), 0U);
  ASSERT_EQ(differences(a, b, 0.125).size(), 1U);
  EXPECT_EQ(differences(a, b, 0.125)[0].path, "ranges_m[1]");
}

TEST(FieldDifferences, NeverPassOverWholeNumbersNorNan) {
  domain::Scan a = scan_of({1.0});
  domain::Scan b = scan_of({std::numeric_limits<double>::quiet_NaN()});
  b.stamp.tick = 1;

  const auto found = differences(a, b, 1e9);

  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].path, "stamp.tick");
  EXPECT_EQ(found[1].path, "ranges_m[0]");
}

TEST(FieldText, IsTheShortestThatReadsBackAndShowsWhatCannotBeSeen) {
  EXPECT_EQ(field_text(0.1), "0.1");
  EXPECT_EQ(field_text(std::nextafter(0.1, 1.0)), "0.10000000000000002");
  EXPECT_EQ(field_text(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(field_text(std::string("a\"b\n")), "\"a\\\"b\\x0a\"");
  EXPECT_EQ(field_text(true), "true");
}

}  // namespace
}  // namespace clew::bridge

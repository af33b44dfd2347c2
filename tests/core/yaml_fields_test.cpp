// SPDX-License-Identifier: Apache-2.0
#include "core/yaml_fields.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace clew::core {
namespace {

YamlNode parse(const std::string& yaml) {
  auto node = YamlNode::parse(yaml, "a.yaml");
  EXPECT_TRUE(node.ok()) << node.error().text();
  return *std::move(node);
}

std::string answer(const Result<void>& result) {
  return result.ok() ? "accepted" : result.error().text();
}

TEST(YamlFields, TheFormatIsTheOneExpected) {
  const auto check = [](const char* yaml) { return answer(check_format(parse(yaml), "clew-a/1")); };

  EXPECT_EQ(check("format: clew-a/1"), "accepted");
  EXPECT_EQ(check("format: clew-a/2"), "a.yaml:1:9: found 'clew-a/2', expected clew-a/1");
  EXPECT_EQ(check("format: [clew-a/1]"), "a.yaml:1:9: found a list of 1, expected clew-a/1");
  EXPECT_EQ(check("name: a"), "a.yaml:1:1: missing key 'format', expected clew-a/1");
}

TEST(YamlFields, ANumberIsWithinItsRange) {
  double rate = 0.0;
  const auto read = [&](const char* yaml) {
    return answer(read_number(parse(yaml), "rate", {0.25, 2.0}, rate));
  };

  EXPECT_EQ(read("rate: 0.5"), "accepted");
  EXPECT_EQ(rate, 0.5);
  EXPECT_EQ(read("rate: 0.25"), "accepted");
  EXPECT_EQ(read("rate: 2"), "accepted");
  EXPECT_EQ(read("rate: 0.125"), "a.yaml:1:7: found 0.125, expected a number from 0.25 to 2");
  EXPECT_EQ(read("rate: 3"), "a.yaml:1:7: found 3, expected a number from 0.25 to 2");
  EXPECT_EQ(read("rate: high"), "a.yaml:1:7: found 'high', expected a finite number");
  EXPECT_EQ(read("race: 1"), "a.yaml:1:1: missing key 'rate'");
}

TEST(YamlFields, AnAngleIsWrittenInDegrees) {
  double angle_rad = 0.0;
  const auto read = [&](const char* yaml) {
    return answer(read_angle(parse(yaml), "turn_deg", {-90.0, 90.0}, angle_rad));
  };

  EXPECT_EQ(read("turn_deg: 45"), "accepted");
  EXPECT_DOUBLE_EQ(angle_rad, kPi / 4.0);
  EXPECT_EQ(read("turn_deg: 91"), "a.yaml:1:11: found 91, expected a number from -90 to 90");
}

TEST(YamlFields, NumbersAreThreeWithinTheirRange) {
  std::array<double, 3> classes{};
  const auto read = [&](const char* yaml) {
    return answer(read_numbers(parse(yaml), "classes", "three classes", {0.0, 8.0}, classes));
  };

  EXPECT_EQ(read("classes: [0, 2.5, 8]"), "accepted");
  EXPECT_EQ(classes, (std::array<double, 3>{0.0, 2.5, 8.0}));
  EXPECT_EQ(read("classes: [1, 2]"), "a.yaml:1:10: found a list of 2, expected three classes");
  EXPECT_EQ(read("classes: [1, 9, 2]"), "a.yaml:1:10: found 9, expected a number from 0 to 8");
  EXPECT_EQ(read("class: [1]"), "a.yaml:1:1: missing key 'classes'");
}

TEST(YamlFields, CountsAreThreeWholeNumbersFromOne) {
  std::array<std::uint32_t, 3> counts{};
  const auto read = [&](const char* yaml) {
    return answer(read_counts(parse(yaml), "cells", counts));
  };

  EXPECT_EQ(read("cells: [1, 20, 300]"), "accepted");
  EXPECT_EQ(counts, (std::array<std::uint32_t, 3>{1, 20, 300}));
  EXPECT_EQ(read("cells: [1, 2]"), "a.yaml:1:8: found a list of 2, expected three counts");
  EXPECT_EQ(read("cells: [1, 0, 2]"), "a.yaml:1:8: found 0, expected whole numbers of at least 1");
  EXPECT_EQ(read("cells: [1, 2.5, 2]"),
            "a.yaml:1:8: found 2.5, expected whole numbers of at least 1");
  EXPECT_EQ(read("cells: [1, 1e10, 2]"),
            "a.yaml:1:8: found 10000000000, expected whole numbers of at least 1");
}

TEST(YamlFields, ACountIsAWholeNumberWithinItsRange) {
  std::uint64_t field = 0;
  const auto read = [&](const char* yaml) {
    return answer(read_count(parse(yaml), "n", 1, 20, field));
  };

  EXPECT_EQ(read("n: 20"), "accepted");
  EXPECT_EQ(field, 20u);
  EXPECT_EQ(read("n: 0"), "a.yaml:1:4: found '0', expected a whole number from 1 to 20");
  EXPECT_EQ(
      answer(read_count(parse("n: -1"), "n", 0, std::numeric_limits<std::int64_t>::max(), field)),
      "a.yaml:1:4: found '-1', expected a whole number of at least 0");
  EXPECT_EQ(read("n: 21"), "a.yaml:1:4: found '21', expected a whole number from 1 to 20");
  EXPECT_EQ(read("m: 3"), "a.yaml:1:1: missing key 'n'");
}

TEST(YamlFields, NamesAreAListThatIsNotEmpty) {
  std::vector<std::string> names;
  const auto read = [&](const char* yaml) { return answer(read_names(parse(yaml), "n", names)); };

  EXPECT_EQ(read("n: [a, b]"), "accepted");
  EXPECT_EQ(names, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(read("n: []"), "a.yaml:1:4: found an empty list, expected at least one name");
  EXPECT_NE(read("n: [[a]]"), "accepted");
}

}  // namespace
}  // namespace clew::core

// SPDX-License-Identifier: Apache-2.0
#include "core/yaml_text.hpp"

#include <gtest/gtest.h>

#include "core/yaml_reader.hpp"

namespace clew::core {
namespace {

/// A value with all that it holds, in one line: kind, place, text.
std::string told(const YamlNode& node) {
  std::string text = std::to_string(node.line()) + ':' + std::to_string(node.column());
  if (node.kind() == YamlKind::kList) {
    text += '[';
    const auto items = node.items();
    for (const YamlNode& item : *items) text += told(item) + ' ';
    return text + ']';
  }
  if (node.kind() == YamlKind::kMap) {
    text += '{';
    const auto entries = node.entries();
    for (const YamlNode::Entry& entry : *entries) {
      text += entry.key + '@' + told(entry.key_node) + '=' + told(entry.value) + ' ';
    }
    return text + '}';
  }
  return text + ' ' + node.found();
}

/// A list of this many walls, as long as its reader takes notice of.
std::string walls(int count, const std::string& between) {
  std::string text = "[";
  for (int i = 0; i < count; ++i) text += between + "[" + std::to_string(i) + ", -0.5,1e-3, +.5],";
  return text + "\n]";
}

// A key that is set in is no long list of numbers to the reader; all columns are one greater.
std::string without_columns(const std::string& text) {
  std::string kept;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == ':') {
      while (i + 1 < text.size() && text[i + 1] >= '0' && text[i + 1] <= '9') ++i;
    } else {
      kept += text[i];
    }
  }
  return kept;
}

TEST(YamlText, FindsLongListsOfNumbersWithTheirPlaces) {
  const std::string yaml = "name: a\nwalls: [[1, 2], [3,\n 4],]\nb: [5]\nc: [6, 7, 8]\n";

  const auto lists = find_number_lists(yaml, 9);

  ASSERT_EQ(lists.size(), 2U);
  EXPECT_EQ(yaml.substr(lists[0].begin, lists[0].end - lists[0].begin), "[[1, 2], [3,\n 4],]");
  EXPECT_EQ(lists[0].line, 2);
  EXPECT_EQ(lists[0].column, 8);
  EXPECT_EQ(yaml.substr(lists[1].begin, lists[1].end - lists[1].begin), "[6, 7, 8]");
  EXPECT_EQ(lists[1].line, 5);
  EXPECT_EQ(lists[1].column, 4);
}

TEST(YamlText, LeavesAllElseToTheParser) {
  for (const std::string yaml :
       {"a: [1, 2 3]", "a: [1, b]", "a: [1, '2']", "a: [1, 2 # 3\n]", "a: [1, [], 2]", "a: [1,, 2]",
        "a: [, 1, 2]", "a: [1, 2, 3", "a: [1: 2, 3]", "a: [1, -, 3]", "a: [1, ..., 3]",
        "a: [1,\n---\n, 3]", " a: [1, 2, 3]", "a:[1, 2, 3]", "- a: [1, 2]", "a: [1, 2]\r\n",
        "a: [1,\t2, 3]", "A: [1, 2, 3]", "# a: [1, 2, 3]"}) {
    EXPECT_TRUE(find_number_lists(yaml, 3).empty()) << yaml;
  }
}

TEST(YamlText, KeepsThePlacesOfAllThatIsLeft) {
  const std::string yaml = "a: [1,\n 2, 3] # so\nb: [4, 5]\nc: 6";

  EXPECT_EQ(without_number_lists(yaml, find_number_lists(yaml, 6)),
            "a: [\n     ] # so\nb: []\nc: 6");
}

// What a long list is read as does not depend on who reads it.
TEST(YamlReader, ReadsLongListsAsItReadsShortOnes) {
  for (const std::string between : {"", "\n", "\n  ", "   "}) {
    const std::string list = walls(2000, between);
    const std::string fast = "first: 1\nwalls: " + list + "\nlast: [2, 3]\n";
    const std::string slow = " first: 1\n walls: " + list + "\n last: [2, 3]\n";
    ASSERT_EQ(find_number_lists(fast, 4096).size(), 1U);
    ASSERT_TRUE(find_number_lists(slow, 4096).empty());

    const auto by_us = YamlNode::parse(fast, "fast");
    const auto by_parser = YamlNode::parse(slow, "slow");

    ASSERT_TRUE(by_us.ok()) << by_us.error().text();
    ASSERT_TRUE(by_parser.ok());
    EXPECT_EQ(without_columns(told(*by_us)), without_columns(told(*by_parser)));
    // The place of the last number of the list, which both have in the same column.
    const auto last = [](const YamlNode& root) {
      return (*(*root.find("walls")->items()).back().items()).back();
    };
    EXPECT_EQ(last(*by_us).line(), last(*by_parser).line());
    const int set_in = between.find('\n') == std::string::npos ? 1 : 0;
    EXPECT_EQ(last(*by_us).column() + set_in, last(*by_parser).column());
  }
}

TEST(YamlReader, ReadsAListWithinQuotesAsText) {
  const std::string yaml = "about: \"so\nwalls: " + walls(2000, "\n") + "\n\"\nlast: 1\n";
  ASSERT_EQ(find_number_lists(yaml, 4096).size(), 1U);

  const auto node = YamlNode::parse(yaml, "quoted");

  ASSERT_TRUE(node.ok()) << node.error().text();
  EXPECT_EQ(node->find("walls"), std::nullopt);
  const auto about = node->find("about")->string();
  ASSERT_TRUE(about.ok());
  EXPECT_NE(about->find("[1999, -0.5,1e-3, +.5]"), std::string::npos);
}

TEST(YamlReader, TellsWhatIsWrongInALongListAtItsPlace) {
  const std::string yaml = "walls: " + walls(1000, "\n") + "\nlast: [2\n";

  const auto broken = YamlNode::parse(yaml, "broken");
  const auto twice = YamlNode::parse("walls: " + walls(1000, "\n") + "\nwalls: 1\n", "twice");

  ASSERT_FALSE(broken.ok());
  EXPECT_NE(broken.error().text().find("broken YAML"), std::string::npos);
  ASSERT_FALSE(twice.ok());
  EXPECT_EQ(twice.error().text(), "twice:1003:1: duplicate key 'walls', first given in line 1");
}

}  // namespace
}  // namespace clew::core

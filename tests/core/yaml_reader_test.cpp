// SPDX-License-Identifier: Apache-2.0
#include "core/yaml_reader.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/nearest_name.hpp"

namespace clew::core {
namespace {

YamlNode parse(const std::string& yaml) {
  auto node = YamlNode::parse(yaml, "a.yaml");
  EXPECT_TRUE(node.ok()) << node.error().text();
  return *std::move(node);
}

std::string refusal(const std::string& yaml) {
  const auto node = YamlNode::parse(yaml, "a.yaml");
  return node.ok() ? "accepted" : node.error().text();
}

template <typename T>
std::string text_of(const Result<T>& result) {
  return result.ok() ? "accepted" : result.error().text();
}

TEST(YamlReader, ReadsEachTypeOfValue) {
  const YamlNode root =
      parse("{n: -2.5e-1, i: 42, b: true, s: 'it''s', q: \"\\\"\", l: [1, 2], nothing: }");

  EXPECT_EQ(*root.at("n")->number(), -0.25);
  EXPECT_EQ(*root.at("i")->integer(), 42);
  EXPECT_TRUE(*root.at("b")->boolean());
  EXPECT_EQ(*root.at("s")->string(), "it's");
  EXPECT_EQ(*root.at("q")->string(), "\"");
  EXPECT_EQ(root.at("l")->items()->size(), 2u);
  EXPECT_EQ(*root.at("l")->numbers(2, "[x, y]"), (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(root.at("nothing")->kind(), YamlKind::kNull);
}

TEST(YamlReader, KnowsThePlaceOfEachValue) {
  const YamlNode root = parse("a: 1\nb:\n  - x\n  - {c: y}\n");

  const auto items = root.at("b")->items();

  EXPECT_EQ((*items)[0].line(), 3);
  EXPECT_EQ((*items)[0].column(), 5);
  EXPECT_EQ((*items)[1].at("c")->line(), 4);
  EXPECT_EQ((*items)[1].at("c")->column(), 9);
}

TEST(YamlReader, KeepsTheOrderOfKeys) {
  const YamlNode root = parse("z: 1\na: 2\nm: 3\n");

  const auto entries = root.entries();

  ASSERT_EQ(entries->size(), 3u);
  EXPECT_EQ((*entries)[0].key, "z");
  EXPECT_EQ((*entries)[1].key, "a");
  EXPECT_EQ((*entries)[2].key, "m");
  EXPECT_EQ((*entries)[2].key_node.line(), 3);
}

TEST(YamlReader, AValueOutlivesTheNodeItCameFrom) {
  const auto value = [] { return *parse("a: kept").at("a"); }();

  EXPECT_EQ(*value.string(), "kept");
}

TEST(YamlReader, RefusesDuplicateKeys) {
  EXPECT_EQ(refusal("a: 1\nb: 2\na: 3\n"), "a.yaml:3:1: duplicate key 'a', first given in line 1");
}

TEST(YamlReader, RefusesWhatIsEasilyMistaken) {
  EXPECT_EQ(refusal(""), "a.yaml: the file is empty");
  EXPECT_EQ(refusal("# only a comment\n"), "a.yaml: the file is empty");
  EXPECT_EQ(refusal("a: &x 1\nb: *x\n"),
            "a.yaml:1:4: an anchor; write the value out where it is needed");
  EXPECT_EQ(refusal("a: !!str 1\n"), "a.yaml:1:4: a tag; none is allowed");
  EXPECT_EQ(refusal("a: 1\n---\nb: 2\n"),
            "a.yaml:2:1: a second document begins here; one a file is allowed");
  EXPECT_EQ(refusal("{[1, 2]: 3}"), "a.yaml:1:2: a key that is no text");
}

TEST(YamlReader, SaysWhereYamlIsBroken) {
  EXPECT_EQ(refusal("a: [1, 2\nb: 3\n"), "a.yaml:2:2: broken YAML: end of sequence flow not found");
  EXPECT_EQ(refusal("a: 'it''s open\n"),
            "a.yaml:1:4: a text that begins with a quote and does not end with one");
  EXPECT_EQ(refusal("a: \"open\\\"\n"),
            "a.yaml:1:4: a text that begins with a quote and does not end with one");
  EXPECT_NE(refusal("\ta: 1\n"), "accepted");
}

TEST(YamlReader, RefusesBottomlessNesting) {
  const std::string yaml = std::string(100000, '[') + std::string(100000, ']');

  EXPECT_NE(refusal(yaml), "accepted");
}

TEST(YamlReader, RefusesNumbersThatAreNoFiniteNumbers) {
  for (const char* text : {".nan", ".inf", "-.inf", "nan", "inf", "1e999", "1.0.0", "0x10", "+-1",
                           "1 2", "abc", "'1'", "1m", "true"}) {
    const YamlNode root = parse(std::string("a: ") + text);

    EXPECT_FALSE(root.at("a")->number().ok()) << text;
  }
  EXPECT_EQ(text_of(parse("a: .nan").at("a")->number()),
            "a.yaml:1:4: found '.nan', expected a finite number");
  EXPECT_EQ(text_of(parse("a: \"1\"").at("a")->number()),
            "a.yaml:1:4: found the text \"1\", expected a finite number");
}

TEST(YamlReader, RefusesOtherWrongTypes) {
  const YamlNode root = parse("{a: 1.5, l: [1, 2, 3], m: {x: 1}, n: }");

  EXPECT_EQ(text_of(root.at("a")->integer()), "a.yaml:1:5: found '1.5', expected a whole number");
  EXPECT_EQ(text_of(root.at("a")->boolean()), "a.yaml:1:5: found '1.5', expected true or false");
  EXPECT_EQ(text_of(root.at("l")->numbers(2, "[x, y]")),
            "a.yaml:1:13: found a list of 3, expected [x, y]");
  EXPECT_EQ(text_of(root.at("m")->string()), "a.yaml:1:27: found a map, expected a text");
  EXPECT_EQ(text_of(root.at("m")->items()), "a.yaml:1:27: found a map, expected a list");
  EXPECT_EQ(text_of(root.at("l")->entries()), "a.yaml:1:13: found a list of 3, expected a map");
  EXPECT_FALSE(root.at("n")->number().ok());
  EXPECT_EQ(root.at("n")->found(), "nothing");
}

TEST(YamlReader, RefusesUnknownAndMissingKeys) {
  const YamlNode root = parse("rnage_m: 1.5\n");

  EXPECT_EQ(text_of(root.check_keys({"noise_stddev_m", "range_m"})),
            "a.yaml:1:1: unknown key 'rnage_m' (did you mean 'range_m'?); allowed: "
            "noise_stddev_m, range_m");
  EXPECT_EQ(text_of(root.at("range_m")), "a.yaml:1:1: missing key 'range_m'");
  EXPECT_FALSE(root.find("range_m").has_value());
}

TEST(NearestName, IsWithinAThirdOfTheLetters) {
  const std::vector<std::string> known{"walls", "circles", "start"};

  EXPECT_EQ(nearest_name("wals", known), "walls");       // one letter missing
  EXPECT_EQ(nearest_name("cirlces", known), "circles");  // two neighbours swapped
  EXPECT_EQ(nearest_name("sstarrt", known), "start");    // two of seven too many
  EXPECT_EQ(nearest_name("stop", known), "");            // two of four differ: stop, star(t)
  EXPECT_EQ(nearest_name(std::string(1000, 'w'), known), "");
}

TEST(NearestName, WithoutKnownNamesNothingIsAllowed) {
  EXPECT_EQ(unknown_name("key", "a", {}), "unknown key 'a'; none is allowed here");
}

}  // namespace
}  // namespace clew::core

// SPDX-License-Identifier: Apache-2.0
#include "insides/inside_json.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "insides/explanation.hpp"

namespace clew::insides {
namespace {

TEST(InsideJson, NamesNumbersWithTheirUnitsInTheOrderTold) {
  domain::InsideGroup group;
  group.number("distance", 1.5, "m");
  group.flag("virtual", false);
  group.text("wall", "left");
  group.list("readings", {0.5, 1.0}, "m");
  group.place("target", {1.0, -2.0});

  EXPECT_EQ(to_json(group).dump(),
            R"({"distance_m":1.5,"virtual":false,"wall":"left","readings_m":[0.5,1.0],)"
            R"("target":{"x_m":1.0,"y_m":-2.0}})");
}

TEST(InsideJson, SaysNoneOfABoundThatIsNotThere) {
  domain::InsideGroup group;
  group.bound("nearest", std::numeric_limits<double>::infinity(), "m");
  group.bound("left_at", 3.0, "m");

  EXPECT_EQ(to_json(group).dump(), R"({"nearest_m":"none","left_at_m":3.0})");
}

TEST(InsideJson, GathersItemsOfOneName) {
  domain::InsideGroup group;
  group.item("goals").number("x", 1.0, "m");
  group.item("goals").number("x", 2.0, "m");

  EXPECT_EQ(to_json(group).dump(), R"({"goals":[{"x_m":1.0},{"x_m":2.0}]})");
}

TEST(InsideJson, GivesAGridRowByRowWithTheMarkedPlace) {
  domain::InsideGroup group;
  group.grid("costs", {3, {1.0, 2.0, 3.0, 4.0, 5.0, 6.0}, "x", "y", 5});

  EXPECT_EQ(to_json(group).dump(),
            R"({"costs":{"columns":3,"rows":2,"columns_are":"x","rows_are":"y",)"
            R"("values":[[1.0,2.0,3.0],[4.0,5.0,6.0]],"marked":[1,2]}})");
}

TEST(InsideJson, GivesPlacesToATenthOfAMillimetre) {
  domain::Picture picture;
  picture.layers.push_back({"path", domain::PictureLayer::Kind::kWay, {}, {{0.12344, 2.0}}});

  EXPECT_EQ(to_json(picture).dump(),
            R"([{"name":"path","kind":"way","places":[[0.1234,2.0]],"cells":[]}])");
}

TEST(Inside, AddsAPartWithItsSentenceValuesAndPicture) {
  domain::Inside part;
  part.say("It sees a wall.");
  part.values.number("near", 0.5);
  part.picture.layers.push_back({"returns", domain::PictureLayer::Kind::kPoints, {}, {}});
  domain::Inside whole;
  whole.say("First.");

  whole.add("controller", part);

  EXPECT_EQ(whole.text, "First. It sees a wall.");
  EXPECT_EQ(to_json(whole.values).dump(), R"({"controller":{"near":0.5}})");
  EXPECT_EQ(whole.picture.layers.size(), 1U);
}

TEST(Explanation, WrapsBetweenWordsOnly) {
  EXPECT_EQ(wrapped("one two three", 7), "one two\nthree");
  EXPECT_EQ(wrapped("unbreakable word", 5), "unbreakable\nword");
  EXPECT_EQ(wrapped("", 5), "");
}

}  // namespace
}  // namespace clew::insides

// SPDX-License-Identifier: Apache-2.0
#include "core/parameters.hpp"

#include <gtest/gtest.h>

#include "core/fuzzy.hpp"
#include "core/resources.hpp"

namespace clew::core {

enum class Side { kLeft, kRight };

struct Settings {
  double range_m = 1.5;
  double turn_rad = radians(15.0);
  std::int64_t depth = 6;
  bool mirrored = false;
  Side side = Side::kRight;
  std::vector<std::string> networks{"som"};
  std::string rules = "default";
};

template <typename Visitor>
void visit_parameters(Visitor& visit, Settings& s) {
  visit.number("range_m", s.range_m, "m", {0.1, 20.0}, "how far");
  visit.angle("turn_deg", s.turn_rad, {0.0, 90.0}, "turn");
  visit.integer("depth", s.depth, "1", {1, 100}, "queue");
  visit.flag("mirrored", s.mirrored, "mirror");
  visit.choice("side", s.side, {{"left", Side::kLeft}, {"right", Side::kRight}}, "side");
  visit.words("networks", s.networks, {"som", "art"}, "who classifies");
  visit.file("rules", s.rules, "rulebases", "rules");
}

namespace {

const ParameterInfo& named(const std::vector<ParameterInfo>& infos, const std::string& name) {
  for (const ParameterInfo& info : infos) {
    if (info.name == name) return info;
  }
  throw std::out_of_range(name);
}

TEST(Parameters, AreDescribedInTheOrderOfTheirDeclaration) {
  const auto infos = describe_parameters<Settings>();

  ASSERT_EQ(infos.size(), 7u);
  EXPECT_EQ(infos.front().name, "range_m");
  EXPECT_EQ(infos.back().name, "rules");
}

TEST(Parameters, AreDescribedWithUnitRangeAndDefault) {
  const auto infos = describe_parameters<Settings>();

  const ParameterInfo& range = named(infos, "range_m");
  EXPECT_EQ(range.unit, "m");
  EXPECT_EQ(range.doc, "how far");
  EXPECT_EQ(range.range->min, 0.1);
  EXPECT_EQ(range.range->max, 20.0);
  EXPECT_EQ(range.default_value, ParameterValue(1.5));
  EXPECT_EQ(named(infos, "depth").default_value, ParameterValue(std::int64_t{6}));
  EXPECT_EQ(named(infos, "mirrored").default_value, ParameterValue(false));
  EXPECT_EQ(named(infos, "side").default_value, ParameterValue(std::string("right")));
  EXPECT_EQ(named(infos, "side").choices, (std::vector<std::string>{"left", "right"}));
  EXPECT_EQ(named(infos, "networks").choices, (std::vector<std::string>{"som", "art"}));
  EXPECT_EQ(named(infos, "rules").folder, "rulebases");
}

TEST(Parameters, AnglesAreDegreesInFilesAndRadiansInside) {
  auto values = default_values(describe_parameters<Settings>());
  EXPECT_EQ(values.at("turn_deg"), ParameterValue(15.0));  // 15, not 15.000000000000002

  values["turn_deg"] = 90.0;

  EXPECT_EQ(read_parameters<Settings>(values).turn_rad, kPi / 2.0);
}

TEST(Parameters, DefaultsReadBackAreTheDefaults) {
  const Settings defaults;

  const auto read = read_parameters<Settings>(default_values(describe_parameters<Settings>()));

  EXPECT_EQ(read.range_m, defaults.range_m);
  EXPECT_EQ(read.turn_rad, defaults.turn_rad);
  EXPECT_EQ(read.depth, defaults.depth);
  EXPECT_EQ(read.mirrored, defaults.mirrored);
  EXPECT_EQ(read.side, defaults.side);
  EXPECT_EQ(read.networks, defaults.networks);
  EXPECT_EQ(read.rules, defaults.rules);
}

TEST(Parameters, AreReadFromValues) {
  const ParameterValues values = {{"range_m", 3.0},
                                  {"turn_deg", 0.0},
                                  {"depth", std::int64_t{2}},
                                  {"mirrored", true},
                                  {"side", std::string("left")},
                                  {"networks", std::vector<std::string>{"art", "som"}},
                                  {"rules", std::string("other")}};

  const auto read = read_parameters<Settings>(values);

  EXPECT_EQ(read.range_m, 3.0);
  EXPECT_EQ(read.turn_rad, 0.0);
  EXPECT_EQ(read.depth, 2);
  EXPECT_TRUE(read.mirrored);
  EXPECT_EQ(read.side, Side::kLeft);
  EXPECT_EQ(read.networks, (std::vector<std::string>{"art", "som"}));
  EXPECT_EQ(read.rules, "other");
}

TEST(ParametersDeathTest, ReadingWhatWasNotCheckedAborts) {
  auto values = default_values(describe_parameters<Settings>());
  auto mistyped = values;
  mistyped["depth"] = 2.0;
  values.erase("range_m");

  EXPECT_DEATH(read_parameters<Settings>(values), "parameter range_m was not checked");
  EXPECT_DEATH(read_parameters<Settings>(mistyped), "parameter depth was not checked");
}

TEST(Resources, AreFoundByFolderAndName) {
  Resources resources;
  resources.add("rulebases", "som", {"som.yaml", "text"});

  EXPECT_EQ(resources.find("rulebases", "som")->text, "text");
  EXPECT_EQ(resources.find("rulebases", "art").error().text(), "no data file 'rulebases/art'");
  EXPECT_EQ(resources.find("robots", "som").error().text(), "no data file 'robots/som'");
}

TEST(Membership, FallsLinearlyBetweenFullAndNone) {
  EXPECT_EQ(falling_membership(0.0, 1.0, 3.0), 1.0);
  EXPECT_EQ(falling_membership(1.0, 1.0, 3.0), 1.0);
  EXPECT_EQ(falling_membership(1.5, 1.0, 3.0), 0.75);
  EXPECT_EQ(falling_membership(2.0, 1.0, 3.0), 0.5);
  EXPECT_EQ(falling_membership(3.0, 1.0, 3.0), 0.0);
  EXPECT_EQ(falling_membership(9.0, 1.0, 3.0), 0.0);
}

}  // namespace
}  // namespace clew::core

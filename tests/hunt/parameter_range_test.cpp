// SPDX-License-Identifier: Apache-2.0
#include "hunt/parameter_range.hpp"

#include <gtest/gtest.h>

namespace clew::hunt {
namespace {

TEST(ParameterRange, IsToldFromAValue) {
  const auto settings = read_settings({"sense.range_m=0.5..1.5", "control.gain=2"});

  ASSERT_TRUE(settings.ok());
  EXPECT_EQ(settings->fixed, std::vector<std::string>{"control.gain=2"});
  ASSERT_EQ(settings->ranges.size(), 1u);
  EXPECT_EQ(settings->ranges[0].setting(0.0), "sense.range_m=0.5");
  EXPECT_EQ(settings->ranges[0].setting(0.25), "sense.range_m=0.75");
  EXPECT_EQ(settings->ranges[0].setting(1.0), "sense.range_m=1.5");
}

TEST(ParameterRange, OfWholeNumbersGivesEachAnEqualPart) {
  const auto settings = read_settings({"a.n=3..6"});

  ASSERT_TRUE(settings.ok());
  const ParameterRange& range = settings->ranges[0];
  EXPECT_EQ(range.setting(0.0), "a.n=3");
  EXPECT_EQ(range.setting(0.24), "a.n=3");
  EXPECT_EQ(range.setting(0.26), "a.n=4");
  EXPECT_EQ(range.setting(0.76), "a.n=6");
  EXPECT_EQ(range.setting(1.0), "a.n=6");
}

TEST(ParameterRange, MayBeNegative) {
  const auto settings = read_settings({"a.x=-2.0..-1"});

  ASSERT_TRUE(settings.ok());
  EXPECT_EQ(settings->ranges[0].setting(0.5), "a.x=-1.5");
}

TEST(ParameterRange, NamesItsParameterWhenItIsRefused) {
  EXPECT_EQ(read_settings({"a.x=2..1"}).error().text(),
            "--set a.x: the range 2..1 is empty; its first end must be below its second");
  for (const char* text :
       {"a.x=1..", "a.x=..2", "a.x=1..b", "a.x=1...3", "a.x=nan..3", "a.x=0..inf"}) {
    const auto settings = read_settings({text});
    ASSERT_FALSE(settings.ok()) << text;
    EXPECT_EQ(settings.error().file, "--set a.x");
  }
}

}  // namespace
}  // namespace clew::hunt

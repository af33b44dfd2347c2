// SPDX-License-Identifier: Apache-2.0
#include "runtime/goals.hpp"

#include <gtest/gtest.h>

#include "fake_stages.hpp"

namespace clew::runtime {
namespace {

const std::string kHead = "world: open-field\nrobot: disc-015\nsense: {behaviour: cones}\n";
const std::string kStages = "control: {behaviour: straight}\ndrive: {behaviour: slow}\n";

std::string refusal(const std::string& text) {
  const auto goals = parse_goals(text);
  return goals.ok() ? "taken" : goals.error().message;
}

TEST(GoalsOfAChange, AreOnePlaceOrSeveralWithARadiusEach) {
  const auto one = parse_goals("1.5,-2");
  const auto several = parse_goals("1,2,0.5/3,4/-5e-1,6,1");

  ASSERT_TRUE(one.ok());
  ASSERT_TRUE(several.ok());
  ASSERT_EQ(one->size(), 1u);
  EXPECT_EQ((*one)[0].place, core::Vec2(1.5, -2.0));
  EXPECT_FALSE((*one)[0].radius_m);
  ASSERT_EQ(several->size(), 3u);
  EXPECT_EQ((*several)[0].radius_m, 0.5);
  EXPECT_FALSE((*several)[1].radius_m);
  EXPECT_EQ((*several)[2].place, core::Vec2(-0.5, 6.0));
}

TEST(GoalsOfAChange, AreWrittenAsTheyAreRead) {
  for (const char* text : {"1,2", "1,2,0.5", "1,2,0.5/3,4/5,6,1", "none"}) {
    const auto goals = parse_goals(text);
    ASSERT_TRUE(goals.ok()) << text;
    EXPECT_EQ(goals_change(*goals), std::string("goal=") + text);
  }
}

TEST(GoalsOfAChange, SayWhichPlaceIsNone) {
  EXPECT_EQ(
      refusal("1,2/3"),
      "way-point 2, '3': found a list of 1, expected goal=X,Y[,RADIUS[,HEADING[,TOLERANCE]]]");
  EXPECT_EQ(refusal(""),
            "'goal=': found a list of 0, expected goal=X,Y[,RADIUS[,HEADING[,TOLERANCE]]]");
  EXPECT_EQ(refusal("1,2/"),
            "way-point 2, '': found a list of 0, expected goal=X,Y[,RADIUS[,HEADING[,TOLERANCE]]]");
  EXPECT_NE(refusal("1,nan"), "taken");
  EXPECT_NE(refusal("1,2]\n[3,4"), "taken");
  EXPECT_NE(refusal("1,[2]"), "taken");
}

TEST(GoalsOfAChange, AreNotMoreThanAllowed) {
  std::string text = "1,2";
  for (std::size_t i = 1; i < world::kMostGoals; ++i) text += "/1,2";

  EXPECT_EQ(refusal(text), "taken");
  EXPECT_EQ(refusal(text + "/1,2"), "found 257 way-points; allowed: 256");
}

TEST(GoalsOfAGraph, StandInItAsTheyWereRead) {
  for (const char* line : {"goal: [1, 2]\n", "goal: [1, 2, 0.5]\n", "goal: none\n",
                           "mission: [[1, 2], [3, 4, 0.5]]\n"}) {
    const Graph graph = load_good(kHead + line + kStages);
    ASSERT_TRUE(graph.goals) << line;
    EXPECT_NE(graph.expanded_yaml().find(line), std::string::npos) << graph.expanded_yaml();
  }
  EXPECT_FALSE(load_good(kHead + kStages).goals);
  EXPECT_EQ(load_good(kHead + "mission: [[1, 2]]\n" + kStages).expanded_yaml(),
            load_good(kHead + "goal: [1, 2]\n" + kStages).expanded_yaml());
}

TEST(GoalsOfAChange, MayNameAHeadingWithATolerance) {
  const auto goals = parse_goals("1,2,0.5,1.5/3,4,~,-7e-1,0.2/5,6");

  ASSERT_TRUE(goals.ok()) << goals.error().message;
  ASSERT_TRUE((*goals)[0].heading);
  EXPECT_EQ((*goals)[0].heading->heading_rad, 1.5);
  EXPECT_EQ((*goals)[0].heading->tolerance_rad, 0.1);
  EXPECT_EQ((*goals)[0].radius_m, 0.5);
  EXPECT_FALSE((*goals)[1].radius_m);  // the world's
  EXPECT_EQ((*goals)[1].heading->heading_rad, -0.7);
  EXPECT_EQ((*goals)[1].heading->tolerance_rad, 0.2);
  EXPECT_FALSE((*goals)[2].heading);
  EXPECT_EQ(goals_change(*goals), "goal=1,2,0.5,1.5,0.1/3,4,~,-0.7,0.2/5,6");
  EXPECT_EQ(goals_yaml(*goals), "mission: [[1, 2, 0.5, 1.5, 0.1], [3, 4, ~, -0.7, 0.2], [5, 6]]\n");
}

TEST(GoalsOfAChange, RefuseAHeadingThatIsNone) {
  EXPECT_EQ(refusal("1,2,0.5,90"),
            "'goal=1,2,0.5,90': the heading is 90; allowed: -2 pi to 2 pi, in radians");
  EXPECT_EQ(
      refusal("1,2,0.5,1,0"),
      "'goal=1,2,0.5,1,0': the tolerance of the heading is 0; allowed: above 0 and at most pi, "
      "in radians");
  EXPECT_NE(refusal("1,2,0.5,1,4"), "taken");
  EXPECT_NE(refusal("1,2,0.5,1,1,1"), "taken");
  EXPECT_NE(refusal("1,2,0.5,~"), "taken");
}

}  // namespace
}  // namespace clew::runtime

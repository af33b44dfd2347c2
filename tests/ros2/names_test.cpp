// SPDX-License-Identifier: Apache-2.0
#include "ros2/names.hpp"

#include <gtest/gtest.h>

#include "ros2/node.hpp"

namespace clew::ros2 {
namespace {

TEST(Names, ANamespaceStandsBeforeRelativeNamesOnly) {
  const Names names("robot1", {});

  EXPECT_EQ(names.node_namespace(), "/robot1");
  EXPECT_EQ(names.topic("scan"), "/robot1/scan");
  EXPECT_EQ(names.topic("/tf"), "/tf");
  EXPECT_EQ(names.frame("odom"), "robot1/odom");
}

TEST(Names, WithoutANamespaceNamesAreAbsolute) {
  const Names names("", {});

  EXPECT_EQ(names.node_namespace(), "/");
  EXPECT_EQ(names.topic("scan"), "/scan");
  EXPECT_EQ(names.frame("odom"), "odom");
}

TEST(Names, TheFirstRuleThatFitsHolds) {
  const Names names("/r", {{"scan", "front/scan"}, {"/r/scan", "/never"}, {"/tf", "tf"}});

  EXPECT_EQ(names.topic("scan"), "/r/front/scan");
  EXPECT_EQ(names.topic("/tf"), "/r/tf");
  EXPECT_EQ(names.topic("odom"), "/r/odom");
}

TEST(Names, RefusesWhatIsNoNameOfRos) {
  for (const char* bad : {"", "/", "a//b", "a/", "1a", "a/2", "a-b", "a b", "~a"}) {
    EXPECT_FALSE(check_topic_name(bad).ok()) << bad;
  }
  for (const char* good : {"a", "/a", "a/b_2", "_hidden"}) {
    EXPECT_TRUE(check_topic_name(good).ok()) << good;
  }
  EXPECT_FALSE(parse_remap_rule("scan=front").ok());
  EXPECT_FALSE(parse_remap_rule("scan:=").ok());
}

TEST(Names, ATopicOnTheWireHasThePrefixOfRos) { EXPECT_EQ(dds_topic("/a/scan"), "rt/a/scan"); }

TEST(Origin, TakesNothingThatCameFromItself) {
  const Origin own{"run-7", 1};

  EXPECT_FALSE(own.may_take("typehash=RIHS01_00;" + own.to_text()));
  EXPECT_TRUE(own.may_take("typehash=RIHS01_00;"));
  EXPECT_TRUE(own.may_take(Origin{"run-8", 1}.to_text()));
}

TEST(Origin, TakesNothingThatWentThroughTooManyBridges) {
  const Origin own{"run-7", 1};

  EXPECT_TRUE(own.may_take(Origin{"run-8", Origin::kMostHops - 1}.to_text()));
  EXPECT_FALSE(own.may_take(Origin{"run-8", Origin::kMostHops}.to_text()));
}

}  // namespace
}  // namespace clew::ros2

// SPDX-License-Identifier: Apache-2.0
#include "dds/origin.hpp"

#include <gtest/gtest.h>

namespace clew::bridge {
namespace {

TEST(Origin, IsReadAsItIsWritten) {
  const Origin origin{"4711-3", 3, {"5f2a-20", "5f2a-21"}};

  const Origin read = Origin::parse("typehash=RIHS01_00;" + origin.to_text());

  EXPECT_EQ(origin.to_text(), "clew_origin=4711-3;clew_hops=3;clew_via=5f2a-20,5f2a-21;");
  EXPECT_EQ(read.id, origin.id);
  EXPECT_EQ(read.hops, origin.hops);
  EXPECT_EQ(read.via, origin.via);
}

TEST(Origin, IsNoneWithoutAnEntry) {
  EXPECT_TRUE(Origin::parse("").id.empty());
  EXPECT_TRUE(Origin::parse("clew_idl=00;;clew_hops").id.empty());
  EXPECT_EQ(Origin{}.to_text(), "");
}

TEST(Origin, HasBeenWhereItBeganAndInBetween) {
  const Origin origin{"a", 2, {"b"}};

  EXPECT_TRUE(origin.has_been_on("a"));
  EXPECT_TRUE(origin.has_been_on("b"));
  EXPECT_FALSE(origin.has_been_on("c"));
}

TEST(Origin, IsTakenOutOfUserDataWithWhatIsNamed) {
  EXPECT_EQ(without_origin("clew_idl=1;clew_stage=sense;clew_origin=a;clew_hops=1;clew_via=b;x;",
                           {"clew_stage"}),
            "clew_idl=1;x;");
}

}  // namespace
}  // namespace clew::bridge

// SPDX-License-Identifier: Apache-2.0
#include "line/user_data.hpp"

#include <gtest/gtest.h>

namespace clew::bridge {
namespace {

TEST(UserData, IsReadAsItWasWritten) {
  const UserData parsed = UserData::parse(UserData{"abc", "sense"}.to_text());

  EXPECT_EQ(parsed.idl_fingerprint, "abc");
  EXPECT_EQ(parsed.stage, "sense");
}

TEST(UserData, LeavesOutAStageThatIsNotTold) {
  EXPECT_EQ((UserData{"abc", ""}.to_text()), "clew_idl=abc;");
}

TEST(UserData, PassesOverWhatItDoesNotKnow) {
  const UserData parsed = UserData::parse("enclave=/;junk;clew_idl=abc;=;clew_stage=sense");

  EXPECT_EQ(parsed.idl_fingerprint, "abc");
  EXPECT_EQ(parsed.stage, "sense");
}

}  // namespace
}  // namespace clew::bridge

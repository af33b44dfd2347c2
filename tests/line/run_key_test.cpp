// SPDX-License-Identifier: Apache-2.0
#include "line/run_key.hpp"

#include <gtest/gtest.h>

#include <string>

namespace clew::bridge {
namespace {

// 24 digits of the participant, 8 of the entity.
const std::string kGuid = "0123456789abcdef01234567000001c1";
const std::string kEndpoint = "0123456789abcdef0123456700000103";
const std::string kOther = "0123456789abcdef0123456800000103";

TEST(RunKey, SealsWhatTheEndpointsOfAParticipantSay) {
  const RunKey key(std::string(32, 'k'));

  const UserData sealed = key.sealed({"abc", "control"}, kGuid);

  // printf '0123456789abcdef01234567;control;abc' | openssl dgst -sha256 -hmac
  // kkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkk
  EXPECT_EQ(sealed.seal, "ae3e01cc99f2059556500f04a26f66fd");
  EXPECT_TRUE(key.fits(sealed, kEndpoint));
  EXPECT_TRUE(key.fits(UserData::parse(sealed.to_text()), kEndpoint));
}

TEST(RunKey, KnowsAForgedOne) {
  const RunKey key = RunKey::make();
  const UserData sealed = key.sealed({"abc", "control"}, kGuid);

  EXPECT_FALSE(key.fits(sealed, kOther));                              // read, and said again
  EXPECT_FALSE(key.fits({"abc", "drive", sealed.seal}, kEndpoint));    // of another stage
  EXPECT_FALSE(key.fits({"abd", "control", sealed.seal}, kEndpoint));  // of other IDL
  EXPECT_FALSE(key.fits({"abc", "control"}, kEndpoint));               // none
  EXPECT_FALSE(key.fits({"abc", "control", "0"}, kEndpoint));          // too short
  EXPECT_FALSE(RunKey::make().fits(sealed, kEndpoint));                // of another run
}

TEST(RunKey, OfNoRunAsksForNoSeal) {
  EXPECT_EQ(RunKey().sealed({"abc", "control"}, kGuid).seal, "");
  EXPECT_TRUE(RunKey().fits({"abc", "control"}, kEndpoint));
}

}  // namespace
}  // namespace clew::bridge

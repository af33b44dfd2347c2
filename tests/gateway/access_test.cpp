// SPDX-License-Identifier: Apache-2.0
#include "gateway/access.hpp"

#include <gtest/gtest.h>

namespace clew::bridge {
namespace {

const std::string kToken = "0123456789abcdef0123456789abcdef";

class AccessRule : public ::testing::Test {
 protected:
  AccessRule() { access_.set_port(4711); }

  Credentials own_page() const { return {"127.0.0.1:4711", "http://127.0.0.1:4711", "", cookies_}; }

  Access access_{kToken};
  std::string cookies_ = "other=1; clew_view_4711=" + kToken;
};

TEST_F(AccessRule, AddressCarriesTheToken) {
  EXPECT_EQ(access_.address(), "http://127.0.0.1:4711/?token=" + kToken);
}

TEST_F(AccessRule, CookieIsForNoScriptAndNoOtherSite) {
  EXPECT_EQ(access_.cookie_header(),
            "clew_view_4711=" + kToken + "; HttpOnly; SameSite=Strict; Path=/");
}

TEST_F(AccessRule, TokensDifferAndHave128Bits) {
  const Access one = Access::with_random_token();
  const Access other = Access::with_random_token();

  EXPECT_EQ(one.token().size(), 32U);
  EXPECT_NE(one.token(), other.token());
}

TEST_F(AccessRule, ReadsWithTheTokenOrTheCookieOnly) {
  const std::string query = "token=" + kToken;

  EXPECT_TRUE(access_.may_read({"127.0.0.1:4711", "", query, ""}));
  EXPECT_TRUE(access_.may_read({"localhost:4711", "", "", cookies_}));
  EXPECT_FALSE(access_.may_read({"127.0.0.1:4711", "", "", ""}));
  EXPECT_FALSE(access_.may_read({"127.0.0.1:4711", "", "token=", ""}));
  EXPECT_FALSE(access_.may_read({"127.0.0.1:4711", "", query.substr(0, query.size() - 1), ""}));
  EXPECT_FALSE(access_.may_read({"127.0.0.1:4711", "", "", "clew_view_4712=" + kToken}));
}

TEST_F(AccessRule, ANameThatPointsHereIsNoHostOfOurs) {
  const std::string query = "token=" + kToken;

  for (const char* host : {"evil.example", "evil.example:4711", "127.0.0.1", "127.0.0.1:80", "",
                           "127.0.0.1:4711.evil.example"}) {
    EXPECT_FALSE(access_.may_read({host, "", query, cookies_})) << host;
  }
}

TEST_F(AccessRule, AForeignPageReadsNothingEvenWithTheCookie) {
  Credentials request = own_page();
  request.origin = "http://evil.example";

  EXPECT_FALSE(access_.may_read(request));
  EXPECT_FALSE(access_.may_control(request));
}

TEST_F(AccessRule, OnlyOurOwnPageWithTheCookieControls) {
  EXPECT_TRUE(access_.may_control(own_page()));

  Credentials without_origin = own_page();
  without_origin.origin = "";
  EXPECT_FALSE(access_.may_control(without_origin));

  const std::string query = "token=" + kToken;
  Credentials with_token = own_page();
  with_token.cookies = "";
  with_token.query = query;
  EXPECT_FALSE(access_.may_control(with_token));

  Credentials other_port = own_page();
  other_port.origin = "http://127.0.0.1:4712";
  EXPECT_FALSE(access_.may_control(other_port));
}

TEST(QueryValue, FindsWholeNamesOnly) {
  EXPECT_EQ(query_value("a=1&token=x&b=2", "token"), "x");
  EXPECT_EQ(query_value("mytoken=x", "token"), "");
  EXPECT_EQ(query_value("", "token"), "");
  EXPECT_EQ(query_value("token", "token"), "");
}

}  // namespace
}  // namespace clew::bridge

// SPDX-License-Identifier: Apache-2.0
#include "security/policy.hpp"

#include <gtest/gtest.h>

namespace clew::bridge {
namespace {

// 2026-11-28 12:34:56 UTC
constexpr std::time_t kNoon = 1795869296;

TEST(Permissions, AreReadAsTheyWereWritten) {
  const Grant grant{"CN=recover-3", {kNoon, kNoon + 60}, {{"event", "guidance"}, {"scan"}}};

  const auto read = read_permissions(permissions_text(grant));

  ASSERT_TRUE(read.ok()) << read.error().text();
  ASSERT_EQ(read->size(), 1u);
  EXPECT_EQ(read->front().subject, grant.subject);
  EXPECT_EQ(read->front().validity.not_before, grant.validity.not_before);
  EXPECT_EQ(read->front().validity.not_after, grant.validity.not_after);
  EXPECT_EQ(read->front().rights.writes, grant.rights.writes);
  EXPECT_EQ(read->front().rights.reads, grant.rights.reads);
}

TEST(Permissions, SayTheTimeInUtc) {
  const std::string text = permissions_text({"CN=a-1", {kNoon, kNoon}, {}});

  EXPECT_NE(text.find("<not_before>2026-11-28T12:34:56</not_before>"), std::string::npos) << text;
}

TEST(Permissions, NameATimeThatIsNone) {
  std::string text = permissions_text({"CN=a-1", {kNoon, kNoon}, {}});
  text.replace(text.find("2026-11-28"), 10, "28.11.2026");

  const auto read = read_permissions(text);

  ASSERT_FALSE(read.ok());
  EXPECT_NE(read.error().text().find("not_before is '28.11.2026T12:34:56'; expected a time"),
            std::string::npos);
}

TEST(Permissions, WithARuleThatDeniesAreRefused) {
  std::string text = permissions_text({"CN=a-1", {kNoon, kNoon}, {}});
  text.replace(text.find("<default>"), 0, "<deny_rule></deny_rule>");

  EXPECT_EQ(read_permissions(text).error().text(), "has a deny_rule; allowed: allow_rule");
}

TEST(Permissions, ThatAreNoXmlAreRefused) {
  EXPECT_EQ(read_permissions("<dds><permissions>").error().text(), "is no XML");
}

TEST(Governance, OfOursIsStrongEnough) { EXPECT_EQ(governance_weakness(governance_text()), ""); }

TEST(Governance, OfNoDomainIsTold) {
  EXPECT_EQ(governance_weakness("<dds><domain_access_rules/></dds>"), "has no domain_rule");
}

}  // namespace
}  // namespace clew::bridge

// SPDX-License-Identifier: Apache-2.0
#include "domain/topics.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace clew::domain {
namespace {

TEST(Topics, AreInTheOrderOfTheirNames) {
  EXPECT_TRUE(std::is_sorted(kAllTopics.begin(), kAllTopics.end(),
                             [](Topic a, Topic b) { return topic_name(a) < topic_name(b); }));
}

TEST(Topics, AreFoundByName) {
  for (const Topic topic : kAllTopics) {
    const std::optional<Topic> found = topic_from_name(topic_name(topic));

    ASSERT_TRUE(found.has_value());
    EXPECT_EQ(*found, topic);
  }
}

TEST(Topics, AreNotFoundByAnotherName) {
  EXPECT_FALSE(topic_from_name("").has_value());
  EXPECT_FALSE(topic_from_name("Scan").has_value());
  EXPECT_FALSE(topic_from_name("scans").has_value());
}

TEST(Topics, HaveTheTypeThatIsNamedLikeThem) {
  EXPECT_EQ(type_name(Topic::kScan), "clew::msg::Scan");
  EXPECT_EQ(type_name(topic_of<Odometry>()), "clew::msg::Odometry");
}

TEST(Topics, AreVisitedWithTheirMessageType) {
  for (const Topic topic : kAllTopics) {
    visit_topic(topic, [&](auto constant) {
      EXPECT_EQ(topic_of<MessageOf<decltype(constant)::value>>(), topic);
    });
  }
}

}  // namespace
}  // namespace clew::domain

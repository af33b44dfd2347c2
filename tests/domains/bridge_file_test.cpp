// SPDX-License-Identifier: Apache-2.0
#include "domains/bridge_file.hpp"

#include <gtest/gtest.h>

namespace clew::domains {
namespace {

constexpr char kFile[] = R"(format: clew-bridge/1
domains:
  robot: {run: my-run}
  site: {domain: 20, middleware: fastdds, network: true}
topics:
  - {topic: scan, from: robot, to: site, as: r1/scan, type: clew::msg::Scan, rate_hz: 5, where: stamp.tick > 9, depth: 3, reliability: best_effort}
  - {topic: rt/*, from: site, to: [robot], as: rt/site/*}
)";

core::Result<BridgeFile> read(const std::string& text) {
  return read_bridge_file({"bridge.yaml", text});
}

TEST(BridgeFile, IsReadWhole) {
  const auto file = read(kFile);

  ASSERT_TRUE(file.ok()) << file.error().text();
  ASSERT_EQ(file->domains.size(), 2u);
  EXPECT_EQ(file->domains[0].run, "my-run");
  EXPECT_FALSE(file->domains[0].on_network);
  EXPECT_EQ(file->domains[1].run, "20");
  EXPECT_EQ(file->domains[1].vendor, bridge::Vendor::kFastDds);
  EXPECT_TRUE(file->domains[1].on_network);
  ASSERT_EQ(file->rules.size(), 2u);
  const TopicRule& rule = file->rules[0];
  EXPECT_EQ(rule.from, 0u);
  EXPECT_EQ(rule.to, (std::vector<std::size_t>{1}));
  EXPECT_EQ(rule.type, "clew::msg::Scan");
  EXPECT_EQ(rule.rate_hz, 5.0);
  ASSERT_EQ(rule.where.size(), 1u);
  EXPECT_EQ(rule.where[0].text, "stamp.tick > 9");
  EXPECT_EQ(rule.depth, 3);
  EXPECT_TRUE(rule.best_effort);
  EXPECT_FALSE(file->rules[1].best_effort);
}

TEST(BridgeFile, RenamesOneTopicOrAllOfAPattern) {
  const auto file = read(kFile);
  ASSERT_TRUE(file.ok()) << file.error().text();

  EXPECT_EQ(file->rules[0].renamed("scan"), "r1/scan");
  EXPECT_EQ(file->rules[0].renamed("scans"), std::nullopt);
  EXPECT_EQ(file->rules[1].renamed("rt/odom"), "rt/site/odom");
  EXPECT_EQ(file->rules[1].renamed("rt/"), "rt/site/");
  EXPECT_EQ(file->rules[1].renamed("ros_discovery_info"), std::nullopt);
}

struct Refusal {
  std::string from;
  std::string to;
  std::string message;
};

class BridgeFileRefuses : public testing::TestWithParam<Refusal> {};

TEST_P(BridgeFileRefuses, WithPlaceAndWhatIsAllowed) {
  std::string text = kFile;
  text.replace(text.find(GetParam().from), GetParam().from.size(), GetParam().to);

  const auto file = read(text);

  ASSERT_FALSE(file.ok());
  EXPECT_NE(file.error().text().find(GetParam().message), std::string::npos) << file.error().text();
}

INSTANTIATE_TEST_SUITE_P(
    Files, BridgeFileRefuses,
    testing::Values(
        Refusal{"clew-bridge/1", "clew-bridge/2", "bridge.yaml:1"},
        Refusal{"topics:", "topcis:", "unknown key 'topcis' (did you mean 'topics'?)"},
        Refusal{"{run: my-run}", "{run: my-run, domain: 3}", "one of the two"},
        Refusal{"{run: my-run}", "{domain: 20, network: true}",
                "bridge.yaml:4:9: 'robot' and 'site' are the same domain"},
        Refusal{"domain: 20", "domain: 120", "bridge.yaml:4:18"},
        Refusal{"middleware: fastdds", "middleware: dds", "allowed: cyclonedds, fastdds"},
        Refusal{"from: robot", "from: robto", "unknown domain 'robto' (did you mean 'robot'?)"},
        Refusal{"to: site", "to: robot", "that is where the topic comes from"},
        Refusal{"to: [robot]", "to: [robot, robot]", "it stands twice in the list"},
        Refusal{"to: [robot]", "to: []", "at least one domain"},
        Refusal{"as: rt/site/*", "as: rt/site", "it needs a '*' where the topic has one"},
        Refusal{"topic: rt/*", "topic: r*/*", "at most one '*'"},
        Refusal{"rate_hz: 5", "rate_hz: 0", "allowed: above 0"},
        Refusal{"depth: 3", "depth: 0", "allowed: 1 to 10000"},
        Refusal{"stamp.tick > 9", "stamp.tock > 9", "clew::msg::Scan has no such field"},
        Refusal{"reliability: best_effort", "reliability: none", "allowed: copied, best_effort"},
        Refusal{"- {topic: rt/*, from: site, to: [robot], as: rt/site/*}",
                "- {topic: scan, from: robot, to: [site], as: r1/scan, type: clew::msg::Scan}",
                "bridge.yaml:7:5: that is asked for twice"}));

}  // namespace
}  // namespace clew::domains

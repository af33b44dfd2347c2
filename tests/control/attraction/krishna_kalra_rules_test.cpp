// SPDX-License-Identifier: Apache-2.0
#include "control/attraction/krishna_kalra_rules.hpp"

#include <gtest/gtest.h>

#include "core/angle.hpp"
#include "tests/source_files.hpp"

namespace clew::control {
namespace {

using tests::rule_base;
using tests::with;

std::string refusal_of(const std::string& from, const std::string& to) {
  const auto rules = KrishnaKalraRules::parse(
      {"rules.yaml", with(rule_base("krishna_kalra_control").text, from, to)});
  return rules.ok() ? "accepted" : rules.error().message;
}

TEST(KrishnaKalraRules, AreThoseOfTheShippedFile) {
  const auto rules = KrishnaKalraRules::parse(rule_base("krishna_kalra_control"));

  ASSERT_TRUE(rules.ok()) << rules.error().text();
  EXPECT_EQ(rules->near_full_ratio, 0.3);
  EXPECT_EQ(rules->near_none_ratio, 0.7);
  EXPECT_EQ(rules->target_turn_rad, core::radians(9.0));
  EXPECT_EQ(rules->near_turns_rad[0], core::radians(40.0));
  EXPECT_EQ(rules->near_turns_rad[3], core::radians(45.0));
  EXPECT_EQ(rules->near_turns_rad[6], core::radians(-40.0));
  EXPECT_EQ(rules->far_turns_rad[2], 0.0);
  EXPECT_EQ(rules->target_far_step_m, 0.15);
  EXPECT_EQ(rules->obstacle_near_step_m, 0.05);
}

TEST(KrishnaKalraRules, RefuseWhatIsNoRuleBase) {
  EXPECT_EQ(refusal_of("clew-krishna-kalra-control/1", "clew-krishna-kalra-control/2"),
            "found 'clew-krishna-kalra-control/2', expected clew-krishna-kalra-control/1");
  EXPECT_EQ(refusal_of("target_turn_deg: 9", "target_turn_deg: 190"),
            "found 190, expected a number from 0 to 180");
  EXPECT_EQ(refusal_of("near_none_ratio: 0.7", "near_none_ratio: 0.3"),
            "near_none_ratio must be more than near_full_ratio");
  EXPECT_EQ(refusal_of("[40, 55, 70, 45, -70, -55, -40]", "[40, 55, 70]"),
            "found a list of 3, expected seven angles, leftmost sensor first");
  EXPECT_EQ(refusal_of("[40, 55,", "[400, 55,"), "found 400, expected a number from -180 to 180");
}

TEST(KrishnaKalraRules, NameTheKeyThatIsMissingOrUnknown) {
  EXPECT_NE(refusal_of("target_turn_deg: 9", "").find("target_turn_deg"), std::string::npos);
  EXPECT_NE(refusal_of("target_turn_deg: 9", "target_turns_deg: 9").find("target_turn_deg"),
            std::string::npos);
}

TEST(KrishnaKalraRules, TellThePlaceOfTheMistake) {
  const auto rules =
      KrishnaKalraRules::parse({"rules.yaml", with(rule_base("krishna_kalra_control").text,
                                                   "target_turn_deg: 9", "target_turn_deg: nine")});

  ASSERT_FALSE(rules.ok());
  EXPECT_EQ(rules.error().file, "rules.yaml");
  EXPECT_GT(rules.error().line, 1);
}

}  // namespace
}  // namespace clew::control

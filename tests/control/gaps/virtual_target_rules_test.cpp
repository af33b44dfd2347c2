// SPDX-License-Identifier: Apache-2.0
#include "control/gaps/virtual_target_rules.hpp"

#include <gtest/gtest.h>

#include "core/angle.hpp"
#include "tests/source_files.hpp"

namespace clew::control {
namespace {

using tests::file_of;

using core::radians;

constexpr double kTolerance = 1e-12;

core::Resource shipped() { return file_of("configs/rulebases/nakhaeinia_nvt.yaml"); }

std::string refusal_of(const std::string& from, const std::string& to) {
  std::string text = shipped().text;
  const auto rules =
      VirtualTargetRules::parse({"rules.yaml", text.replace(text.find(from), from.size(), to)});
  return rules.ok() ? "accepted" : rules.error().message;
}

TEST(VirtualTargetRules, SayWhatTable1Says) {
  const VirtualTargetRules rules = VirtualTargetRules::parse(shipped()).value();

  // At the peaks of its two sets a rule speaks alone. Smooth, Medium, Large are 0.6, 1.0, 1.6
  // rad/s, Slow, Medium, Fast 0.15, 0.3, 0.5 m/s.
  const double turn[3][5] = {{1.6, 1.6, 1.6, 1.6, 1.6},   // D: rules 1, 7, 13, 4, 10
                             {1.0, 1.0, 1.0, 1.0, 1.0},   // U: rules 11, 2, 8, 14, 5
                             {1.0, 0.6, 0.6, 0.6, 0.6}};  // S: rules 6, 12, 3, 9, 15
  const double speed[3][5] = {
      {0.15, 0.15, 0.15, 0.3, 0.3}, {0.15, 0.3, 0.3, 0.3, 0.5}, {0.3, 0.3, 0.5, 0.5, 0.5}};
  const double position_deg[3] = {30, 60, 90};
  const double distance_m[5] = {0.1, 0.4, 0.8, 1.4, 2.0};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 5; ++j) {
      const auto output = rules.infer(radians(position_deg[i]), distance_m[j]);
      EXPECT_NEAR(output.turn_rate_radps, turn[i][j], kTolerance) << i << ' ' << j;
      EXPECT_NEAR(output.speed_mps, speed[i][j], kTolerance) << i << ' ' << j;
    }
  }
}

TEST(VirtualTargetRules, WeighRulesByTheProductOfTheirDegrees) {
  const VirtualTargetRules rules = VirtualTargetRules::parse(shipped()).value();

  // 45 degrees: half D, half U; 0.25 m: half VN, half N. Rules 1, 7, 11, 2 with a quarter each.
  const auto output = rules.infer(radians(45.0), 0.25);

  EXPECT_NEAR(output.turn_rate_radps, 0.25 * (1.6 + 1.6 + 1.0 + 1.0), kTolerance);
  EXPECT_NEAR(output.speed_mps, 0.25 * (0.15 + 0.15 + 0.15 + 0.3), kTolerance);
}

TEST(VirtualTargetRules, StayFullBeyondTheOuterPeaks) {
  const VirtualTargetRules rules = VirtualTargetRules::parse(shipped()).value();

  EXPECT_NEAR(rules.infer(0.0, 0.0).turn_rate_radps, 1.6, kTolerance);
  EXPECT_NEAR(rules.infer(core::kPi, 50.0).speed_mps, 0.5, kTolerance);
}

TEST(VirtualTargetRules, RefuseWhatIsNoRuleBase) {
  EXPECT_EQ(refusal_of("- [D, VN, Large, Slow]", "- [D, VN, Large]"),
            "found a list of 3, expected [OP, OD, R_V, T_V]");
  EXPECT_EQ(refusal_of("- [D, VN, Large, Slow]", "- [U, VN, Large, Slow]"),
            "a second rule for U and VN");
  EXPECT_EQ(refusal_of("  - [D, VN, Large, Slow]\n", ""), "no rule for D and VN");
  EXPECT_EQ(refusal_of("{D: 30, U: 60, S: 90}", "{D: 30, U: 30, S: 90}"),
            "the peaks of obstacle_position_deg and obstacle_distance_m must rise");
  EXPECT_EQ(refusal_of("Large: 1.6", "Large: 160"), "found 160, expected a number from 0 to 20");
  EXPECT_NE(refusal_of("- [D, VN, Large, Slow]", "- [D, VN, Largest, Slow]").find("Large"),
            std::string::npos);
  EXPECT_NE(refusal_of(", VF: 2", "").find("VF"), std::string::npos);
}

}  // namespace
}  // namespace clew::control

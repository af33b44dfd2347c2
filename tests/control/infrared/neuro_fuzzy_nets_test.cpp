// SPDX-License-Identifier: Apache-2.0
#include "control/infrared/neuro_fuzzy_nets.hpp"

#include <gtest/gtest.h>

#include "tests/source_files.hpp"

namespace clew::control {
namespace {

using tests::file_of;

constexpr char kRules[] = "configs/rulebases/wang_yang_meng.yaml";
constexpr char kPrinted[] = "configs/rulebases/wang_yang_meng_printed.yaml";
constexpr char kTrained[] = "configs/rulebases/wang_yang_meng_trained.yaml";

NeuroFuzzyNets nets_of(const char* path) {
  auto nets = NeuroFuzzyNets::parse(file_of(path));
  EXPECT_TRUE(nets.ok()) << nets.error().text();
  return std::move(nets).value();
}

std::string refusal_of(const char* path, const std::string& from, const std::string& to) {
  std::string text = file_of(path).text;
  text.replace(text.find(from), from.size(), to);
  const auto nets = NeuroFuzzyNets::parse({"rules.yaml", text});
  return nets.ok() ? "accepted" : nets.error().text();
}

TEST(NeuroFuzzyRules, TableOneTurnsTheMoreTheNearerAndDoesNotLookBack) {
  const auto nets = nets_of(kRules).nets;

  double before_mps = 1.0;
  for (std::size_t i = 0; i < NeuroFuzzyNets::kSets; ++i) {
    const double turn_mps =
        nets[NeuroFuzzyNets::kRight1].outputs[i][0] - nets[NeuroFuzzyNets::kLeft1].outputs[i][0];
    EXPECT_LT(turn_mps, before_mps) << i;  // rows from too close to too far
    before_mps = turn_mps;
  }
  EXPECT_EQ(before_mps, 0.0);
  EXPECT_TRUE(nets[NeuroFuzzyNets::kLeft1].ignores_second());
  EXPECT_TRUE(nets[NeuroFuzzyNets::kRight1].ignores_second());
}

TEST(NeuroFuzzyRules, TableOneAsPrintedHasTheRowsInTheOtherOrder) {
  const auto nets = nets_of(kRules).nets;
  const auto printed = nets_of(kPrinted).nets;

  for (const auto place : {NeuroFuzzyNets::kLeft1, NeuroFuzzyNets::kRight1}) {
    for (std::size_t i = 0; i < NeuroFuzzyNets::kSets; ++i) {
      EXPECT_EQ(printed[place].outputs[i], nets[place].outputs[NeuroFuzzyNets::kSets - 1 - i]);
    }
  }
  EXPECT_EQ(printed[NeuroFuzzyNets::kLeft2].outputs, nets[NeuroFuzzyNets::kLeft2].outputs);
}

TEST(NeuroFuzzyRules, TableTwoIsAntisymmetric) {
  const auto nets = nets_of(kRules).nets;

  for (std::size_t i = 0; i < NeuroFuzzyNets::kSets; ++i) {
    for (std::size_t j = 0; j < NeuroFuzzyNets::kSets; ++j) {
      EXPECT_EQ(nets[NeuroFuzzyNets::kLeft2].outputs[i][j],
                nets[NeuroFuzzyNets::kRight2].outputs[j][i]);
    }
  }
  // Its printed corner: left too far, right too close.
  EXPECT_EQ(nets[NeuroFuzzyNets::kLeft2].outputs[3][0], 0.0);
  EXPECT_EQ(nets[NeuroFuzzyNets::kRight2].outputs[3][0], 0.3);
}

TEST(NeuroFuzzyRules, StartWithSpeedsThatRiseByATenth) {
  // Everything too far: M/M and Z/Z, but for what neighbouring sets add.
  const WheelSpeeds free = nets_of(kRules).speeds({255, 255, 255, 255});

  EXPECT_NEAR(free.left_mps, 0.2, 1e-3);
  EXPECT_NEAR(free.right_mps, 0.2, 1e-3);
}

TEST(NeuroFuzzyNets, AreTheSameFromTheirOwnText) {
  const NeuroFuzzyNets nets = nets_of(kTrained);

  const auto again = NeuroFuzzyNets::parse(
      {"again.yaml", "format: clew-neuro-fuzzy-trained/1\ntrained_by: {}\n" + nets.to_yaml()});

  ASSERT_TRUE(again.ok()) << again.error().text();
  EXPECT_EQ(again->to_yaml(), nets.to_yaml());
  EXPECT_EQ(nets.rounded().to_yaml(), nets.to_yaml());
}

TEST(NeuroFuzzyRules, RefuseWhatIsNone) {
  EXPECT_EQ(refusal_of(kRules, "clew-neuro-fuzzy-rules/1", "clew-rules/1"),
            "rules.yaml:3:9: found 'clew-rules/1', expected clew-neuro-fuzzy-rules/1 or "
            "clew-neuro-fuzzy-trained/1");
  EXPECT_NE(refusal_of(kRules, "[S/F,", "[S/G,").find("unknown speed 'G'"), std::string::npos);
  EXPECT_NE(refusal_of(kRules, "[S/F,", "[SF,").find("expected LEFT/RIGHT, as S/FF"),
            std::string::npos);
  EXPECT_NE(refusal_of(kRules, "[Z/Z, S/Z, M/Z, F/Z]", "[Z/Z, S/Z, M/Z]")
                .find("expected a cell for each of TC, C, F, TF"),
            std::string::npos);
  EXPECT_NE(refusal_of(kRules, "width: 19.1", "width: 0").find("from 7 to 255"), std::string::npos);
  EXPECT_NE(refusal_of(kRules, "FF: 0.4", "FF: 4").find("from -2 to 2"), std::string::npos);
}

TEST(NeuroFuzzyTrained, RefusesWhatIsNone) {
  EXPECT_NE(refusal_of(kTrained, "  V_L2:", "  V_X2:").find("unknown key 'V_X2'"),
            std::string::npos);
  EXPECT_NE(refusal_of(kTrained, "    widths:\n", "    widhts:\n").find("unknown key 'widhts'"),
            std::string::npos);
  EXPECT_NE(refusal_of(kTrained, "    centres:\n", "    centres:\n      - [1, 2, 3]\n")
                .find("found a list of 3, expected 2 rows"),
            std::string::npos);
}

}  // namespace
}  // namespace clew::control

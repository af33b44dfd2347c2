// SPDX-License-Identifier: Apache-2.0
/// What binds every behaviour of every stage: a new line in a registry is tested here by itself.
#include <gtest/gtest.h>

#include <algorithm>

#include "contract/behaviour_contract.hpp"
#include "mission.hpp"
#include "stages/all.hpp"

namespace clew::stages {
namespace {

/// A stage's part and one of its variants: `recover.detector=none`.
std::vector<std::string> all_variants() {
  std::vector<std::string> choices;
  for (const runtime::StageInfo& stage : all()) {
    for (const runtime::PartInfo& part : stage.parts) {
      for (const runtime::VariantInfo& variant : part.variants) {
        choices.push_back(stage.name + '.' + part.name + '=' + variant.name);
      }
    }
  }
  return choices;
}

/// Test names take letters, digits and underscores.
std::string test_name(const ::testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '.' || c == '='; }, '_');
  return name;
}

class EveryBehaviour : public ::testing::TestWithParam<std::string> {
 protected:
  /// `recover.detector=none`, taken apart.
  static contract::Subject subject() {
    static const runtime::ConfigPath configs = shipped_configs();
    const std::string& choice = GetParam();
    const std::size_t dot = choice.find('.');
    const std::size_t equals = choice.find('=');
    return contract::find_graph({choice.substr(0, dot), choice.substr(dot + 1, equals - dot - 1),
                                 choice.substr(equals + 1)},
                                configs)
        .value();
  }
  static std::string wrong(core::Result<void> (*rule)(const contract::Subject&)) {
    const auto kept = rule(subject());
    return kept.ok() ? "" : kept.error().text();
  }
};

TEST_P(EveryBehaviour, DeclaresItsParametersInFull) {
  EXPECT_EQ(wrong(contract::check_declarations), "");
}

TEST_P(EveryBehaviour, GivesTheSameSamplesForTheSameRun) {
  EXPECT_EQ(wrong(contract::check_determinism), "");
}

TEST_P(EveryBehaviour, GoesOnAsBeforeAfterSaveAndLoad) {
  EXPECT_EQ(wrong(contract::check_save_and_load), "");
}

TEST_P(EveryBehaviour, KeepsTheRulesOfEveryField) { EXPECT_EQ(wrong(contract::check_bounds), ""); }

TEST_P(EveryBehaviour, KeepsThemWithTheScansOfABrokenSensor) {
  EXPECT_EQ(wrong(contract::check_bad_scans), "");
}

TEST_P(EveryBehaviour, WorksOrIsRefusedAtBothEndsOfEachRange) {
  EXPECT_EQ(wrong(contract::check_parameter_ranges), "");
}

TEST_P(EveryBehaviour, TellsOfItsInsideWithoutBeingChanged) {
  EXPECT_EQ(wrong(contract::check_insides), "");
}

TEST_P(EveryBehaviour, TellsOfItsInsideWheneverItIsAtWork) {
  EXPECT_EQ(wrong(contract::check_tells), "");
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryBehaviour, ::testing::ValuesIn(all_variants()), test_name);

TEST(Stages, StandInTheOrderOfTheFlow) {
  std::vector<std::string> names;
  for (const runtime::StageInfo& stage : all()) names.push_back(stage.name);

  EXPECT_EQ(names,
            (std::vector<std::string>{"sense", "classify", "plan", "recover", "control", "drive"}));
}

/// All parameters that a stage and its variants declare.
std::vector<core::ParameterInfo> parameters_of(const runtime::StageInfo& stage) {
  std::vector<core::ParameterInfo> infos = stage.parameters;
  for (const runtime::PartInfo& part : stage.parts) {
    for (const runtime::VariantInfo& variant : part.variants) {
      infos.insert(infos.end(), variant.parameters.begin(), variant.parameters.end());
    }
  }
  return infos;
}

TEST(Stages, DeclareEveryParameterInFull) {
  for (const runtime::StageInfo& stage : all()) {
    for (const core::ParameterInfo& info : parameters_of(stage)) {
      EXPECT_FALSE(info.doc.empty()) << stage.name << '.' << info.name;
      if (const double* number = std::get_if<double>(&info.default_value)) {
        ASSERT_TRUE(info.range.has_value()) << stage.name << '.' << info.name;
        EXPECT_FALSE(info.unit.empty()) << stage.name << '.' << info.name;
        EXPECT_GE(*number, info.range->min) << stage.name << '.' << info.name;
        EXPECT_LE(*number, info.range->max) << stage.name << '.' << info.name;
      }
    }
  }
}

}  // namespace
}  // namespace clew::stages

// SPDX-License-Identifier: Apache-2.0
/// What binds every behaviour of every stage: a new line in a registry is tested here by itself.
#include <gtest/gtest.h>

#include <algorithm>

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

constexpr char kWorld[] = "kk-fig12-hooks";  // with a trap, where all parts get to work

/// The first of the shipped graphs, the fullest one before all others, in which a choice fits.
std::string graph_for(const std::string& choice) {
  std::vector<std::string> graphs = shipped_graphs();
  graphs.insert(graphs.begin(), "krishna_kalra");
  for (const std::string& graph : graphs) {
    if (Mission::refusal(graph, kWorld, {choice}).empty()) return graph;
  }
  ADD_FAILURE() << choice << " fits in no shipped graph";
  return graphs.front();
}

Mission mission_with(const std::string& choice) {
  // With errors of the sensor and of odometry, so that random numbers are at work as well.
  return Mission(graph_for(choice), kWorld, {choice},
                 {"sense.noise_stddev_m=0.01", "drive.drift_rad_per_sqrt_m=0.01"});
}

class EveryBehaviour : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryBehaviour, GivesTheSameSamplesForTheSameRun) {
  Mission first = mission_with(GetParam());
  Mission second = mission_with(GetParam());

  for (int tick = 0; tick < 500 && !first.over(); ++tick) {
    first.step();
    second.step();
    ASSERT_EQ(first.digest(), second.digest()) << "tick " << tick;
  }
}

TEST_P(EveryBehaviour, GoesOnAsBeforeAfterSaveAndLoad) {
  Mission uninterrupted = mission_with(GetParam());
  std::vector<std::string> digests;
  std::vector<Mission::Saved> breaks;
  // A break every 29 ticks falls into step 1, turning about, following and seeking.
  for (int tick = 0; tick < 500 && !uninterrupted.over(); ++tick) {
    if (tick % 29 == 0) breaks.push_back(uninterrupted.save());
    uninterrupted.step();
    digests.push_back(uninterrupted.digest());
  }

  for (const Mission::Saved& saved : breaks) {
    Mission restored = mission_with(GetParam());
    restored.load(saved);
    for (std::uint64_t tick = saved.next_tick; tick < digests.size(); ++tick) {
      restored.step();
      ASSERT_EQ(restored.digest(), digests[tick]) << "saved at " << saved.next_tick << ", " << tick;
    }
  }
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

TEST(Stages, SayWhatEachBehaviourIs) {
  for (const runtime::StageInfo& stage : all()) {
    EXPECT_FALSE(stage.summary.empty());
    for (const runtime::PartInfo& part : stage.parts) {
      for (const runtime::VariantInfo& variant : part.variants) {
        EXPECT_FALSE(variant.summary.empty()) << stage.name << '.' << variant.name;
      }
    }
  }
}

}  // namespace
}  // namespace clew::stages

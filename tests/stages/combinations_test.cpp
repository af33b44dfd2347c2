// SPDX-License-Identifier: Apache-2.0
/// Every controller with every detector, escape, sensor and drive: what fits is accepted and does
/// not collide, what does not is refused with a sentence that says what is needed and what is
/// there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>

#include "mission.hpp"
#include "stages/all.hpp"

namespace clew::stages {
namespace {

constexpr char kWorld[] = "u-trap";
constexpr int kTicks = 300;

using Names = std::vector<std::string>;

const runtime::StageInfo& stage_of(const std::string& name) {
  return *std::find_if(all().begin(), all().end(),
                       [&](const runtime::StageInfo& stage) { return stage.name == name; });
}

const runtime::PartInfo& part_of(const std::string& stage, const std::string& name) {
  const auto& parts = stage_of(stage).parts;
  return *std::find_if(parts.begin(), parts.end(),
                       [&](const runtime::PartInfo& part) { return part.name == name; });
}

Names variants_of(const std::string& stage, const std::string& part) {
  Names names;
  for (const runtime::VariantInfo& variant : part_of(stage, part).variants) {
    names.push_back(variant.name);
  }
  return names;
}

/// Which of a stage's behaviours one is.
std::size_t place_of(const std::string& behaviour, const std::string& stage) {
  const Names names = variants_of(stage, "behaviour");
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), behaviour) - names.begin());
}

bool needs_landmarks(const std::string& detector) {
  for (const runtime::VariantInfo& variant : part_of("recover", "detector").variants) {
    if (variant.name == detector) {
      return variant.needs[index_of(domain::Topic::kLandmark)];
    }
  }
  return false;
}

/// The sensors that a part can do with; parts that are not listed can do with all.
const std::map<std::string, std::set<std::string>> kSensorsFor = {
    {"krishna_kalra_fuzzy", {"cones"}},
    {"neuro_fuzzy", {"infrared"}},
    {"infrared_expert", {"infrared"}},
    {"nearest_virtual_target", {"cones", "laser", "sonar_ring"}},
    {"polar_neural_map", {"laser", "sonar_ring"}},
    {"obstacle_following", {"cones", "laser", "sonar_ring"}},
    {"track_mode", {"cones", "laser", "sonar_ring"}},
    {"no_safe_region", {"cones", "laser", "sonar_ring"}},
    {"no_connecting_path", {"cones", "laser", "sonar_ring"}},
    {"surrounded", {"cones", "laser", "sonar_ring"}},
};

struct Combination {
  std::string sensor;
  std::string drive;
  std::string controller;
  std::string detector;
  std::string escape;

  /// Only the seven cones have a classifier, and with it landmarks.
  bool classifies() const { return sensor == "cones"; }
  std::string graph() const { return classifies() ? "krishna_kalra" : "nakhaeinia"; }
  Names with() const {
    return {"sense.behaviour=" + sensor, "drive.behaviour=" + drive,
            "control.behaviour=" + controller, "recover.detector=" + detector,
            "recover.escape=" + escape};
  }
  std::string text() const {
    return sensor + ' ' + drive + ' ' + controller + ' ' + detector + ' ' + escape;
  }
  /// The parts that do not fit, each with what there is instead of what it needs.
  std::vector<std::pair<std::string, std::string>> misfits() const {
    std::vector<std::pair<std::string, std::string>> misfits;
    for (const std::string& part : {controller, detector, escape}) {
      const auto sensors = kSensorsFor.find(part);
      if (sensors != kSensorsFor.end() && sensors->second.count(sensor) == 0) {
        misfits.emplace_back(part, '\'' + sensor + '\'');
      }
    }
    if (needs_landmarks(detector) && !classifies()) misfits.emplace_back(detector, "landmark");
    return misfits;
  }
};

/// All combinations with a sensor and a drive.
std::vector<Combination> combinations_of(const std::string& sensor, const std::string& drive) {
  std::vector<Combination> combinations;
  for (const std::string& controller : variants_of("control", "behaviour")) {
    for (const std::string& detector : variants_of("recover", "detector")) {
      for (const std::string& escape : variants_of("recover", "escape")) {
        combinations.push_back({sensor, drive, controller, detector, escape});
      }
    }
  }
  return combinations;
}

void expect_a_sentence(const Combination& combination, const std::string& refusal) {
  const auto misfits = combination.misfits();
  EXPECT_TRUE(std::any_of(misfits.begin(), misfits.end(),
                          [&](const auto& misfit) {
                            return refusal.find(misfit.first) != std::string::npos &&
                                   refusal.find(misfit.second) != std::string::npos &&
                                   refusal.find("need") != std::string::npos;
                          }))
      << combination.text() << ": " << refusal;
}

/// With noise, outliers, drop-outs and drift on.
void expect_no_collision(const Combination& combination) {
  Mission mission(
      combination.graph(), kWorld, combination.with(),
      {"sense.noise_stddev_m=0.02", "sense.outlier_ratio=0.01", "sense.drop_out_ratio=0.02",
       "drive.drift_m_per_m=0.02", "drive.drift_rad_per_m=0.01", "drive.drift_rad_per_sqrt_m=0.02",
       "drive.drift_rad_per_sqrt_rad=0.02"});
  for (int tick = 0; tick < kTicks && !mission.over(); ++tick) mission.step();

  EXPECT_EQ(mission.state().collisions, 0u) << combination.text();
  EXPECT_GT(mission.state().path_length_m, 0.5) << combination.text();
}

class EveryCombination : public ::testing::TestWithParam<std::tuple<std::string, std::string>> {};

/// One in four is checked and one in thirty-six driven, others for each sensor and drive. In
/// tools/soak all are.
constexpr std::size_t kForOneChecked = 4;
constexpr std::size_t kForOneDriven = 36;

TEST_P(EveryCombination, FitsAndDoesNotCollideOrIsRefusedWithASentence) {
  const bool soak = std::getenv("CLEW_SOAK") != nullptr;
  const auto& [sensor, drive] = GetParam();
  std::size_t number = place_of(sensor, "sense") * variants_of("drive", "behaviour").size() +
                       place_of(drive, "drive");
  for (const Combination& combination : combinations_of(sensor, drive)) {
    ++number;
    if (!soak && number % kForOneChecked != 0) continue;
    const std::string refusal = Mission::refusal(combination.graph(), kWorld, combination.with());

    if (!combination.misfits().empty()) {
      ASSERT_FALSE(refusal.empty()) << combination.text() << " was accepted";
      expect_a_sentence(combination, refusal);
    } else {
      ASSERT_EQ(refusal, "") << combination.text();
      if (soak || number % kForOneDriven == 0) expect_no_collision(combination);
    }
  }
}

std::string test_name(const ::testing::TestParamInfo<std::tuple<std::string, std::string>>& info) {
  return std::get<0>(info.param) + '_' + std::get<1>(info.param);
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryCombination,
                         ::testing::Combine(::testing::ValuesIn(variants_of("sense", "behaviour")),
                                            ::testing::ValuesIn(variants_of("drive", "behaviour"))),
                         test_name);

}  // namespace
}  // namespace clew::stages

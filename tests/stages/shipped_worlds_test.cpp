// SPDX-License-Identifier: Apache-2.0
/// The whole system of Krishna & Kalra 2000 in every static world that ships.
#include <gtest/gtest.h>

#include <map>

#include "mission.hpp"

namespace clew::stages {
namespace {

using domain::Outcome;

class ShippedWorlds : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    for (const std::string& world : static_worlds()) {
      reports_[world] = Mission("krishna_kalra", world).run();
    }
  }
  static std::map<std::string, Report> reports_;
};
std::map<std::string, Report> ShippedWorlds::reports_;

TEST_F(ShippedWorlds, AreReachedInAtLeastFiftyEightOfSixtyFour) {
  int solvable = 0;
  int reached = 0;
  for (const auto& [world, report] : reports_) {
    if (!is_solvable(world)) continue;
    ++solvable;
    if (report.outcome == Outcome::kReached) ++reached;
  }

  EXPECT_EQ(solvable, 64);
  EXPECT_GE(reached, 58);
}

TEST_F(ShippedWorlds, AreCalledUnreachableOnlyWhereTheyAre) {
  for (const auto& [world, report] : reports_) {
    EXPECT_EQ(report.outcome == Outcome::kUnreachable, !is_solvable(world)) << world;
  }
}

TEST_F(ShippedWorlds, SeeNoCollisionAndFewInterventions) {
  for (const auto& [world, report] : reports_) {
    EXPECT_EQ(report.collisions, 0u) << world;
    EXPECT_LE(report.safety_stops, 5u) << world;
  }
}

TEST(PrintedLaw, CollidesWithoutGuardAndSafetyLayer) {
  const std::vector<std::string> printed = {"control.guard=false", "drive.safety=false"};

  const Report report = Mission("reactive", "kk-fig11a-oscillation", {}, printed).run();

  EXPECT_EQ(report.outcome, Outcome::kCollided);
  EXPECT_EQ(report.collisions, 1u);
}

}  // namespace
}  // namespace clew::stages

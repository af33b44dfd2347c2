// SPDX-License-Identifier: Apache-2.0
/// Why the step guard is a deviation that is needed.
#include <gtest/gtest.h>

#include "mission.hpp"

namespace clew::stages {
namespace {

domain::State drive_to_the_end(const std::vector<std::string>& set) {
  Mission mission("reactive", "kk-fig11a-oscillation", {}, set);
  for (int tick = 0; tick < 500 && !mission.over(); ++tick) mission.step();
  return mission.state();
}

TEST(PrintedLaw, CollidesWithoutGuardAndSafetyLayer) {
  const domain::State state = drive_to_the_end({"control.guard=false", "drive.safety=false"});

  EXPECT_EQ(state.outcome, domain::Outcome::kCollided);
  EXPECT_EQ(state.collisions, 1u);
}

TEST(PrintedLaw, IsHeldBackByTheSafetyLayerAlone) {
  const domain::State state = drive_to_the_end({"control.guard=false"});

  EXPECT_EQ(state.collisions, 0u);
  EXPECT_GT(state.safety_stops, 0u);
}

TEST(PrintedLaw, NeedsNoSafetyLayerWithTheGuard) {
  const domain::State state = drive_to_the_end({"drive.safety=false"});

  EXPECT_EQ(state.collisions, 0u);
}

}  // namespace
}  // namespace clew::stages

// SPDX-License-Identifier: Apache-2.0
/// Runs by subgoals: those of a world, and those of a neural map over what is known or was seen.
#include <gtest/gtest.h>

#include <cstddef>
#include <fstream>
#include <sstream>

#include "mission.hpp"
#include "tests/source_path.hpp"
#include "world/world.hpp"

namespace clew::stages {
namespace {

using domain::Outcome;

constexpr int kTicks = 2000;

void run(Mission& mission) {
  for (int tick = 0; tick < kTicks && !mission.over(); ++tick) mission.step();
}

world::World shipped_world(const std::string& name) {
  const std::string file = tests::source_path("configs/worlds/") + name + ".yaml";
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  return world::World::parse(text.str(), file).value();
}

constexpr double kClose_m = 0.6;  // of the graph's plan

TEST(LagoudakisMaida, TheOfficeTripOfFigure9PassesIts13SubgoalsInOrder) {
  const world::World office = shipped_world("lm-fig09-office");
  Mission mission("lagoudakis_maida", office.name());
  std::size_t passed = 0;

  for (int tick = 0; tick < kTicks && !mission.over(); ++tick) {
    mission.step();
    const core::Pose2& robot = mission.state().pose_world_robot;
    if (passed < office.subgoals().size() &&
        core::distance_m(robot, office.subgoals()[passed]) <= kClose_m) {
      ++passed;
    }
  }

  EXPECT_EQ(passed, 13u);
  EXPECT_EQ(mission.state().outcome, Outcome::kReached);
  EXPECT_EQ(mission.state().collisions, 0u);
  EXPECT_EQ(mission.state().safety_stops, 0u);
}

TEST(LagoudakisMaida, TheNeuralMapFindsTheSubgoalsOfFigures2And9ByItself) {
  for (const char* name : {"lm-fig02-three-walls", "lm-fig09-office"}) {
    for (const char* map : {"plan.map=world", "plan.map=seen"}) {
      Mission mission("lagoudakis_maida", name, {"plan=neural_map"}, {map});

      run(mission);

      EXPECT_EQ(mission.state().outcome, Outcome::kReached) << name << ", " << map;
      EXPECT_EQ(mission.state().collisions, 0u);
      // The polar map takes bends more widely than a disc must.
      EXPECT_LT(mission.state().path_length_m, 1.25 * *shipped_world(name).shortest_path_m());
    }
  }
}

// Sensors of each kind, in a trap that holds a robot without a map.
TEST(SeenMap, LeadsOutOfATrapAsItIsSeen) {
  for (const char* sensor : {"cones", "sonar_ring", "laser", "infrared"}) {
    Mission mission("neural_map", "u-trap",
                    {std::string("sense=") + sensor, "control=fuzzy_behaviourist"},
                    {"plan.map=seen", "plan.cell_m=0.1"});

    run(mission);

    EXPECT_EQ(mission.state().outcome, Outcome::kReached) << sensor;
    EXPECT_EQ(mission.state().collisions, 0u);
  }
}

TEST(SeenMap, GoesOnAsBeforeAfterSaveAndLoad) {
  const std::vector<std::string> seen = {"plan.map=seen"};
  Mission uninterrupted("neural_map", "u-trap", {}, seen);
  std::vector<std::string> digests;
  std::vector<Mission::Saved> breaks;
  for (int tick = 0; tick < 100; ++tick) {
    if (tick % 29 == 0) breaks.push_back(uninterrupted.save());
    uninterrupted.step();
    digests.push_back(uninterrupted.digest());
  }

  for (const Mission::Saved& saved : breaks) {
    Mission restored("neural_map", "u-trap", {}, seen);
    restored.load(saved);
    for (std::uint64_t tick = saved.next_tick; tick < digests.size(); ++tick) {
      restored.step();
      ASSERT_EQ(restored.digest(), digests[tick]) << "saved at " << saved.next_tick << ", " << tick;
    }
  }
}

}  // namespace
}  // namespace clew::stages

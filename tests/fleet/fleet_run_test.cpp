// SPDX-License-Identifier: Apache-2.0
#include "fleet/fleet_run.hpp"

#include <gtest/gtest.h>

#include "runtime/config_source.hpp"
#include "stages/all.hpp"
#include "tests/source_path.hpp"

namespace clew::fleet {
namespace {

class FleetRunTest : public ::testing::Test {
 protected:
  core::Result<FleetPlan> prepare(const std::string& text, std::uint64_t max_ticks = 300) const {
    auto file = read_fleet_file({"fleet.yaml", text}, "fleet");
    if (!file.ok()) return file.error();
    return FleetPlan::prepare(std::move(file).value(), {std::nullopt, max_ticks}, source_, stages_);
  }
  core::Result<FleetPlan> shipped(const std::string& name, std::uint64_t max_ticks) const {
    return prepare(source_.find("fleets", name)->text, max_ticks);
  }
  std::string refusal(const std::string& text) const {
    const auto plan = prepare(text);
    return plan.ok() ? "" : plan.error().text();
  }
  static FleetReport run(const FleetPlan& plan, unsigned threads) {
    FleetOptions options;
    options.threads = threads;
    return *run_fleet(plan, options);
  }

  runtime::ConfigPath source_{{tests::source_path("configs")}};
  std::vector<runtime::StageInfo> stages_ = stages::all();
};

std::string fleet_of(const std::string& robots, const std::string& world = "open-field") {
  return "format: clew-fleet/1\nworld: " + world + "\nrobots:\n" + robots;
}

std::string robot(const std::string& name, const std::string& start, const std::string& more = {}) {
  return "  - {name: " + name + ", graph: among_robots, start: " + start + ", target: [5, 3]" +
         more + "}\n";
}

TEST_F(FleetRunTest, TwentyRobotsHaveOneHashForAnyNumberOfThreads) {
  const auto plan = shipped("twenty_in_a_hall", 60);
  ASSERT_TRUE(plan.ok()) << plan.error().text();
  ASSERT_EQ(plan->robots().size(), 20u);
  const FleetReport one = run(*plan, 1);
  const FleetReport three = run(*plan, 3);
  EXPECT_EQ(one.hash.hex(), three.hash.hex());
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_EQ(one.robots[i].hash.hex(), three.robots[i].hash.hex());
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(one.robots[i].hash, one.robots[j].hash);
  }
}

TEST_F(FleetRunTest, NoTwoRobotsEverOverlap) {
  const auto plan = shipped("twenty_in_a_hall", 250);
  ASSERT_TRUE(plan.ok()) << plan.error().text();
  const FleetReport report = run(*plan, 2);
  EXPECT_EQ(report.contacts, 0u);
  EXPECT_GE(report.least_gap_m, 0.0);
  EXPECT_LT(report.least_gap_m, 0.15);  // they do come near
}

/// Two meet in a gap for one. Without the rule it is the higher index that happens to get through.
TEST_F(FleetRunTest, TheLowerIndexHasTheWayThroughAGap) {
  const auto gap = [](const std::string& graph) {
    return fleet_of("  - {name: west, graph: " + graph +
                        ", start: [1.5, 3, 0], target: [6.5, 3]}\n"
                        "  - {name: east, graph: " +
                        graph + ", start: [6.5, 3.4, 3.1416], target: [1.5, 3.4]}\n",
                    "narrow-gap");
  };
  const auto plan = prepare(gap("among_robots"), 350);
  ASSERT_TRUE(plan.ok()) << plan.error().text();
  const FleetReport report = run(*plan, 2);
  EXPECT_EQ(report.robots[0].statistics.truth->outcome, domain::Outcome::kReached);
  EXPECT_GE(report.robots[1].statistics.traps_detected, 1u);
  EXPECT_EQ(report.contacts, 0u);

  const auto without = prepare(gap("planner"), 350);
  ASSERT_TRUE(without.ok()) << without.error().text();
  EXPECT_EQ(run(*without, 2).robots[0].statistics.truth->outcome, domain::Outcome::kTimeout);
}

TEST_F(FleetRunTest, ARobotByItselfDoesWhatItDidAmongTheOthers) {
  const auto plan = shipped("two_at_a_gap", 200);
  ASSERT_TRUE(plan.ok()) << plan.error().text();
  FleetOptions options;
  options.record = ::testing::TempDir() + "fleet_alone";
  options.force = true;
  const auto report = run_fleet(*plan, options);
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->aborted, "");  // which a hash that differs would be
  for (const RobotReport& robot : report->robots) EXPECT_NE(robot.recording, "") << robot.failure;
}

TEST_F(FleetRunTest, RefusesRobotsInWallsAndInEachOther) {
  EXPECT_EQ(refusal(fleet_of(robot("a", "[1, 1, 0]") + robot("b", "[1.2, 1, 0]"))),
            "fleet.yaml:4:43: robot a at [1, 1] is 0.2 m from robot b at [1.2, 1]; allowed: "
            "0.37096 m and more, both radii and the way of a tick");
  const std::string walled = refusal(fleet_of(robot("a", "[0.1, 1, 0]")));
  EXPECT_NE(walled.find("fleet.yaml:4:43: robot a: a robot of radius 0.15 m does not fit at the "
                        "start [0.1, 1]: the boundary is 0.1 m away"),
            std::string::npos)
      << walled;
  const std::string beyond =
      refusal(fleet_of("  - {name: a, graph: among_robots, start: [1, 1, 0], target: [50, 3]}\n"));
  EXPECT_NE(beyond.find("fleet.yaml:4:"), std::string::npos) << beyond;
  EXPECT_NE(beyond.find("[50, 3] is not within the bounds"), std::string::npos) << beyond;
}

TEST_F(FleetRunTest, RefusesWhatNoFleetCanBe) {
  EXPECT_NE(refusal(fleet_of(robot("a", "[1, 1, 0]") + robot("a", "[3, 1, 0]")))
                .find("'a' is the name of robot 0, too"),
            std::string::npos);
  EXPECT_NE(refusal(fleet_of("  []\n")).find("found 0 robots; allowed: 1 to 64"),
            std::string::npos);
  EXPECT_NE(refusal(fleet_of(robot("../a", "[1, 1, 0]"))).find("allowed: a name of"),
            std::string::npos);
  EXPECT_NE(refusal(fleet_of(robot("a", "[1, 1, 0]", ", set: [drive.safety=false]")))
                .find("drive.safety is false; allowed in a fleet: true"),
            std::string::npos);
  EXPECT_NE(refusal(fleet_of(robot("a", "[1, 1, 0]") +
                             robot("b", "[3, 1, 0]", ", set: [drive.tick_s=0.2]")))
                .find("its tick is 0.2 s, and that of robot a is 0.1 s"),
            std::string::npos);
  const auto many = prepare(fleet_of(robot("a", "[1, 1, 0]")), kMostPlaces + 1);
  ASSERT_FALSE(many.ok());
  EXPECT_NE(many.error().text().find("allowed: 5000000 ticks"), std::string::npos);
}

}  // namespace
}  // namespace clew::fleet

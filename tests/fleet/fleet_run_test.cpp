// SPDX-License-Identifier: Apache-2.0
#include "fleet/fleet_run.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

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
    const auto file = source_.find("fleets", name);
    if (!file.ok()) return file.error();
    return prepare(file->text, max_ticks);
  }
  std::string refusal(const std::string& text) const {
    const auto plan = prepare(text);
    return plan.ok() ? "" : plan.error().text();
  }
  static FleetReport run(const FleetPlan& plan, unsigned threads) {
    FleetOptions options;
    options.threads = threads;
    auto report = run_fleet(plan, options);
    if (!report.ok()) {
      ADD_FAILURE() << report.error().text();
      return {};
    }
    return std::move(report).value();
  }

  static domain::Outcome outcome_of(const RobotReport& robot) {
    return robot.statistics.truth ? robot.statistics.truth->outcome : domain::Outcome::kRunning;
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
  ASSERT_EQ(one.robots.size(), 20u);
  ASSERT_EQ(three.robots.size(), 20u);
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
  ASSERT_EQ(report.robots.size(), 2u);
  EXPECT_EQ(outcome_of(report.robots[0]), domain::Outcome::kReached);
  EXPECT_GE(report.robots[1].statistics.traps_detected, 1u);
  EXPECT_EQ(report.contacts, 0u);

  const auto without = prepare(gap("planner"), 350);
  ASSERT_TRUE(without.ok()) << without.error().text();
  const FleetReport blocked = run(*without, 2);
  ASSERT_EQ(blocked.robots.size(), 2u);
  EXPECT_EQ(outcome_of(blocked.robots[0]), domain::Outcome::kTimeout);
}

TEST_F(FleetRunTest, ARobotByItselfDoesWhatItDidAmongTheOthers) {
  const auto plan = shipped("two_at_a_gap", 200);
  ASSERT_TRUE(plan.ok()) << plan.error().text();
  FleetOptions options;
  options.record = ::testing::TempDir() + "fleet_alone" + std::to_string(::getpid());
  options.force = true;
  const auto report = run_fleet(*plan, options);
  std::filesystem::remove_all(options.record);
  ASSERT_TRUE(report.ok()) << report.error().text();
  EXPECT_EQ(report->aborted, "");  // which a hash that differs would be
  for (const RobotReport& robot : report->robots) EXPECT_NE(robot.recording, "") << robot.failure;
}

/// Robot `a` has arrived long before `b`.
TEST_F(FleetRunTest, ItsTicksAreTheGreatestOfItsRobots) {
  const auto plan = prepare(
      fleet_of(robot("a", "[4, 3, 0]") +
               "  - {name: b, graph: among_robots, start: [1, 1, 0], target: [3, 1, 0.3]}\n"));
  ASSERT_TRUE(plan.ok()) << plan.error().text();
  const FleetReport report = run(*plan, 1);
  ASSERT_EQ(report.robots.size(), 2u);
  std::vector<std::uint64_t> ticks;
  std::vector<double> times_s;
  for (const RobotReport& robot : report.robots) {
    ASSERT_TRUE(robot.statistics.truth);
    EXPECT_EQ(robot.statistics.truth->outcome, domain::Outcome::kReached);
    ticks.push_back(robot.statistics.truth->tick);
    times_s.push_back(robot.statistics.truth->sim_time_s);
  }
  EXPECT_NE(ticks[0], ticks[1]);
  EXPECT_EQ(report.ticks, std::max(ticks[0], ticks[1]));
  EXPECT_EQ(report.sim_time_s, std::max(times_s[0], times_s[1]));
}

/// Files, with one graph that has its SENSE on another host.
class FarGraph : public runtime::ConfigSource {
 public:
  explicit FarGraph(const runtime::ConfigSource& files) : files_(files) {}
  core::Result<core::Resource> find(const std::string& folder,
                                    const std::string& name) const override {
    auto file = files_.find(folder, name);
    const std::string sense = "{behaviour: laser, ";
    if (!file.ok() || folder != "graphs") return file;
    file->text.insert(file->text.find(sense) + sense.size(), "process: {host: far}, ");
    return file;
  }

 private:
  const runtime::ConfigSource& files_;
};

TEST_F(FleetRunTest, RefusesComponentsOnOtherHosts) {
  auto file = read_fleet_file({"fleet.yaml", fleet_of(robot("a", "[1, 1, 0]"))}, "fleet");
  ASSERT_TRUE(file.ok());
  const FarGraph source(source_);
  const auto plan = FleetPlan::prepare(std::move(file).value(), {}, source, stages_);
  ASSERT_FALSE(plan.ok());
  EXPECT_EQ(plan.error().text(),
            "fleet.yaml:4:5: robot a: its sense is on host far; a fleet's components all run "
            "on this host");
}

TEST_F(FleetRunTest, RefusesMoreTicksThanCanBeRecorded) {
  const auto plan = prepare(fleet_of(robot("a", "[1, 1, 0]") + robot("b", "[3, 1, 0]")), 250'001);
  ASSERT_TRUE(plan.ok()) << plan.error().text();
  FleetOptions options;
  options.record = ::testing::TempDir() + "fleet_too_long" + std::to_string(::getpid());
  const auto report = run_fleet(*plan, options);
  ASSERT_FALSE(report.ok());
  EXPECT_EQ(report.error().text(),
            "fleet.yaml:4:3: 2 robots of up to 250001 ticks; allowed: 500000 ticks of all robots "
            "together (max_ticks), if they are recorded, or run as processes");
  EXPECT_FALSE(std::filesystem::exists(options.record));
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
  for (const char* radius : {"0", "-1", "100001"}) {
    EXPECT_EQ(
        refusal(fleet_of("  - {name: a, graph: among_robots, start: [1, 1, 0], target: [5, 3, " +
                         std::string(radius) + "]}\n")),
        "fleet.yaml:4:69: the radius is " + std::string(radius) +
            "; allowed: above 0, at most 100000");
  }
  const auto longest = prepare(fleet_of(robot("a", "[1, 1, 0]")), 1'000'001);
  ASSERT_FALSE(longest.ok());
  EXPECT_EQ(longest.error().text(),
            "fleet.yaml:4:5: robot a: 1000001 ticks of 0.1 s; allowed: 100000 s (max_ticks)");
  EXPECT_TRUE(prepare(fleet_of(robot("a", "[1, 1, 0]")), 1'000'000).ok());
  std::string six;
  for (int i = 0; i < 6; ++i) {
    six += robot("r" + std::to_string(i), "[" + std::to_string(i + 1) + ", 1, 0]");
  }
  const auto many = prepare(fleet_of(six), 1'000'000);
  ASSERT_FALSE(many.ok());
  EXPECT_NE(many.error().text().find("allowed: 5000000 ticks"), std::string::npos);
}

}  // namespace
}  // namespace clew::fleet

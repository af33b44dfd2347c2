// SPDX-License-Identifier: Apache-2.0
/// A change of one parameter is found at the tick and field where it first matters. What is
/// expected is worked out from the recorded messages, by what the parameter means.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "../recording/scratch_directory.hpp"
#include "core/angle.hpp"
#include "recorded_run.hpp"
#include "replay/component_replay.hpp"

namespace clew::replay_test {
namespace {

using namespace bridge;
using domain::Topic;
using recording_test::ScratchDirectory;

class ChangedParameter : public testing::Test {
 protected:
  RunRecording record(const std::string& graph, const std::string& world,
                      std::uint64_t max_ticks = 1000) {
    const std::string path = scratch_.file("run.mcap");
    record_run(plan_of(graph, in_world(world, max_ticks)), path);
    return open_recording(path);
  }
  static SampleDifference first_difference(const RunRecording& recording, const std::string& stage,
                                           const std::string& change) {
    const auto report =
        replay_component(recording, replay_plan(recording, changes({}, {change})), stage);
    EXPECT_TRUE(report.ok()) << report.error().text();
    EXPECT_FALSE(report->identical()) << change;
    return report->first.value_or(SampleDifference{});
  }

  ScratchDirectory scratch_;
};

double number(const std::optional<FieldValue>& value) { return std::get<double>(*value); }

TEST_F(ChangedParameter, TurnOfTheGuardShowsWhereItTurnsTheRobotOnTheSpot) {
  const RunRecording recording = record("reactive", "comb");
  // The guard turns by 15 degrees where it leaves no step.
  const auto commands = messages_of<domain::Command>(recording);
  std::uint64_t tick = 0;
  while (commands[tick].motion.step_m > 0.0) ++tick;
  ASSERT_EQ(std::fabs(commands[tick].motion.turn_rad), core::radians(15.0));

  const auto found = first_difference(recording, "control", "control.guard_turn_deg=20");

  EXPECT_EQ(found.topic, Topic::kCommand);
  EXPECT_EQ(found.tick, tick);
  ASSERT_EQ(found.fields.size(), 1U);
  EXPECT_EQ(found.fields[0].path, "motion.turn_rad");
  EXPECT_EQ(number(found.fields[0].a), commands[tick].motion.turn_rad);
  EXPECT_EQ(number(found.fields[0].b),
            std::copysign(core::radians(20.0), commands[tick].motion.turn_rad));
}

TEST_F(ChangedParameter, LongestStepOfDriveShowsATickAfterALongerCommand) {
  const RunRecording recording = record("reactive", "forest");
  constexpr double kBound_m = 0.12;
  // The command of a tick moves the robot at the start of the next one.
  const auto commands = messages_of<domain::Command>(recording);
  std::uint64_t tick = 0;
  while (commands[tick].motion.step_m <= kBound_m) ++tick;

  const auto found = first_difference(recording, "drive", "drive.max_step_m=0.12");

  EXPECT_EQ(found.topic, Topic::kOdometry);
  EXPECT_EQ(found.tick, tick + 1);
  EXPECT_EQ(found.fields[0].path, "pose_odom_robot.x_m");
  const auto odometry = messages_of<domain::Odometry>(recording);
  const double heading_rad = odometry[tick + 1].pose_odom_robot.heading_rad;
  EXPECT_EQ(number(found.fields[0].b),
            odometry[tick].pose_odom_robot.x_m + kBound_m * core::cos(heading_rad));
}

TEST_F(ChangedParameter, NoiseOfSenseShowsInTheFirstReadingThatReturns) {
  const RunRecording recording = record("reactive", "forest");
  // What does not return has no noise.
  const auto scans = messages_of<domain::Scan>(recording);
  std::uint64_t tick = 0;
  std::size_t beam = 0;
  const auto returns = [&] { return scans[tick].ranges_m[beam] < scans[tick].range_max_m; };
  while (!returns()) {
    if (++beam < scans[tick].ranges_m.size()) continue;
    beam = 0;
    ++tick;
  }

  const auto found = first_difference(recording, "sense", "sense.noise_stddev_m=0.001");

  EXPECT_EQ(found.topic, Topic::kScan);
  EXPECT_EQ(found.tick, tick);
  EXPECT_EQ(found.fields[0].path, "ranges_m[" + std::to_string(beam) + ']');
}

TEST_F(ChangedParameter, NetworksOfClassifyShowWhereTheMapRecognisedALandmark) {
  const RunRecording recording = record("krishna_kalra", "u-trap");
  const auto landmarks = messages_of<domain::Landmark>(recording);
  const auto knew_by_map = [](const domain::Landmark& landmark) {
    for (const auto& recognition : landmark.recognitions) {
      if (recognition.network == domain::Network::kSom) return true;
    }
    return false;
  };
  std::uint64_t tick = 0;
  while (!knew_by_map(landmarks[tick])) ++tick;

  const auto found = first_difference(recording, "classify", "classify.networks=[art]");

  EXPECT_EQ(found.topic, Topic::kLandmark);
  EXPECT_EQ(found.tick, tick);
  // The map stands first in the list; the other network may have an answer, too.
  EXPECT_EQ(found.fields[0].path.rfind("recognitions", 0), 0U);
  const auto network =
      std::find_if(found.fields.begin(), found.fields.end(),
                   [](const auto& field) { return field.path == "recognitions[0].network"; });
  ASSERT_NE(network, found.fields.end());
  EXPECT_EQ(network->a, FieldValue(std::string_view("NETWORK_SOM")));
  EXPECT_NE(network->b, network->a);
}

TEST_F(ChangedParameter, VisitsThatProveALoopShowWhereTheTrapWasFound) {
  const RunRecording recording = record("krishna_kalra", "u-trap");
  const auto events = messages_of<domain::Event>(recording);
  const auto place_of_trap = [](const domain::Event& event) -> std::optional<std::size_t> {
    for (std::size_t i = 0; i < event.entries.size(); ++i) {
      if (event.entries[i].kind == domain::EventKind::kTrap) return i;
    }
    return std::nullopt;
  };
  std::uint64_t tick = 0;
  while (!place_of_trap(events[tick])) ++tick;

  const auto found = first_difference(recording, "recover", "recover.detector.earlier_visits=6");

  // One earlier visit proves it in the recording; six there cannot be yet.
  EXPECT_EQ(found.topic, Topic::kEvent);
  EXPECT_EQ(found.tick, tick);
  EXPECT_EQ(found.fields[0].path, "entries.length");
  EXPECT_EQ(found.fields[1].path,
            "entries[" + std::to_string(*place_of_trap(events[tick])) + "].kind");
  EXPECT_EQ(found.fields[1].a, FieldValue(std::string_view("EVENT_TRAP")));
}

TEST_F(ChangedParameter, ThatDoesNotMatterShowsNowhere) {
  const RunRecording recording = record("reactive", "open-field");

  const auto report = replay_component(
      recording, replay_plan(recording, changes({}, {"control.guard_turn_deg=20"})), "control");

  ASSERT_TRUE(report.ok()) << report.error().text();
  EXPECT_TRUE(report->identical());
}

}  // namespace
}  // namespace clew::replay_test

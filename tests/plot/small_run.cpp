// SPDX-License-Identifier: Apache-2.0
#include "small_run.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "recording/run_recorder.hpp"
#include "wire/codec.hpp"

namespace clew::plot_test {
namespace {

constexpr std::uint64_t kTicks = 10;
constexpr double kTick_s = 0.5;

domain::TickStamp stamp_of(std::uint64_t tick) {
  return {tick, static_cast<double>(tick) * kTick_s, tick};
}

core::Pose2 world_pose(std::uint64_t tick) {
  return {1.0 + 0.5 * static_cast<double>(tick), 2.0, 0.0};
}
core::Pose2 odom_pose(std::uint64_t tick) {
  return {0.5 * static_cast<double>(tick), 0.1 * static_cast<double>(tick), 0.0};
}

void fill(std::uint64_t tick, domain::State& state) {
  state.pose_world_robot = world_pose(tick);
  state.path_length_m = 0.5 * static_cast<double>(tick);
  state.safety_stops = tick >= 8 ? 1 : 0;
  state.hit_by = tick >= 3 ? 1 : 0;
  state.outcome = tick == 9 ? domain::Outcome::kReached : domain::Outcome::kRunning;
}

void fill(std::uint64_t tick, domain::Odometry& odometry) {
  odometry.pose_odom_robot = odom_pose(tick);
}

void fill(std::uint64_t tick, domain::Guidance& guidance) {
  if (tick >= 4 && tick <= 6) guidance.mode = domain::GuidanceMode::kRecover;
  if (tick >= 5) guidance.virtual_obstacles.push_back({2.5, 1.0, 3.5, 1.5});
  if (tick != 6) return;
  guidance.target_is_virtual = true;
  guidance.target_x_m = odom_pose(tick).x_m + 2.0;
  guidance.target_y_m = odom_pose(tick).y_m;
}

void fill(std::uint64_t tick, domain::Command& command) {
  if (tick != 2 && tick != 3) return;
  command.virtual_targets.push_back({4.0, 0.2});
}

void fill(std::uint64_t tick, domain::Landmark& landmark) {
  if (tick != 4) return;
  landmark.presented = true;
  landmark.recognitions.resize(2);
  landmark.recognitions[1].network = domain::Network::kFuzzyArt;
}

void fill(std::uint64_t tick, domain::Event& event) {
  domain::EventEntry entry;
  entry.x_m = odom_pose(tick).x_m;
  entry.y_m = odom_pose(tick).y_m;
  if (tick == 4) {
    entry.kind = domain::EventKind::kTrap;
    entry.has_earlier = true;
    entry.earlier_tick = 1;
    entry.earlier_x_m = odom_pose(1).x_m;
    entry.earlier_y_m = odom_pose(1).y_m;
    event.entries.push_back(entry);
    entry = {};
    entry.x_m = odom_pose(tick).x_m;
    entry.y_m = odom_pose(tick).y_m;
    entry.kind = domain::EventKind::kEscapeBegun;
    event.entries.push_back(entry);
  } else if (tick == 7) {
    entry.kind = domain::EventKind::kEscapeEnded;
    event.entries.push_back(entry);
  }
}

template <typename Message>
void add(bridge::RunRecorder& recorder, std::uint64_t tick) {
  Message message;
  message.stamp = stamp_of(tick);
  fill(tick, message);
  bridge::Codec<Message> codec;
  const auto added = recorder.add(domain::topic_of<Message>(), tick, tick, codec.encode(message));
  ASSERT_TRUE(added.ok()) << added.error().text();
}

}  // namespace

const char* const kWorld = R"(format: clew-world/1
name: small
about: a world with something of every kind in it
bounds: [0, 0, 10, 8]
walls: [[5, 3, 8, 3]]
polygons: [[[1, 5], [2, 5], [2, 6]]]
circles: [[8, 6, 0.5]]
moving: [{circle: [4, 5, 0.3], path: [[0, 4, 5], [10, 4, 7]], loop: false}]
start: [1, 2, 0]
target: [5.5, 2]
target_radius: 0.2
shortest_path: 4.3
)";

SmallRun::SmallRun() {
  description.tick_s = kTick_s;
  description.seed = 7;
  description.idl_fingerprint = std::string(bridge::idl_fingerprint());
  description.bundle = {{"world.yaml", kWorld},
                        {"robot.yaml", "format: clew-robot/1\nname: disc-015\nradius_m: 0.15\n"}};
  for (const auto topic :
       {domain::Topic::kEvent, domain::Topic::kGuidance, domain::Topic::kLandmark,
        domain::Topic::kOdometry, domain::Topic::kState, domain::Topic::kCommand}) {
    description.schemas[topic] = bridge::idl_text(topic);
  }
}

void SmallRun::write(const std::string& path, bool finished) const {
  {
    auto recorder = bridge::RunRecorder::create(path, description, false);
    ASSERT_TRUE(recorder.ok()) << recorder.error().text();
    for (std::uint64_t tick = 0; tick < kTicks; ++tick) {
      add<domain::State>(*recorder, tick);
      add<domain::Odometry>(*recorder, tick);
      add<domain::Guidance>(*recorder, tick);
      add<domain::Landmark>(*recorder, tick);
      add<domain::Event>(*recorder, tick);
      add<domain::Command>(*recorder, tick);
    }
    if (finished) {
      ASSERT_TRUE(recorder->finish().ok());
    }
  }
  if (!finished) std::filesystem::rename(path + ".tmp~", path);
}

}  // namespace clew::plot_test

// SPDX-License-Identifier: Apache-2.0
/// What a tick of recovery on all that was seen costs, with repaired paths of least cost and with
/// A* at the same rate of replanning, in processor time: each leads a robot with a laser of 4 m
/// from the start to the target. Then the same in a field of pillars that was seen whole, 20 m or
/// 200 m wide, and towards a target 20 m or 1000 m away where nothing is.

#include <benchmark/benchmark.h>
#include <time.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "recover/escapes/map_following.hpp"
#include "sense/laser.hpp"
#include "tests/source_path.hpp"

namespace clew::recover {
namespace {

constexpr double kTick_s = 0.3;
constexpr std::size_t kMostTicks = 2000;

world::World world_of(const std::string& name) {
  const std::string path = "configs/worlds/" + name + ".yaml";
  std::ifstream stream(tests::source_path(path), std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  return world::World::parse(text, path).value();
}

/// Of this thread: what else runs on the machine does not count.
double processor_time_us() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e6 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_nsec);
}

/// A pillar every 4 m, laid out from the middle of a square field.
std::vector<core::Vec2> pillars_in(int side_m) {
  std::vector<core::Vec2> pillars;
  for (int x = 1; x < side_m; ++x) {
    for (int y = 1; y < side_m; ++y) {
      if ((x - side_m / 2 + 2) % 4 == 0 && (y - side_m / 2) % 4 == 0) pillars.emplace_back(x, y);
    }
  }
  return pillars;
}
constexpr double kPillar_m = 0.3;

/// A field with such pillars; the robot crosses 14 m of its middle.
world::World field_of_pillars(int side_m) {
  const std::string side = std::to_string(side_m);
  const std::string middle = std::to_string(side_m / 2);
  std::string text = "format: clew-world/1\nname: pillars\nabout: pillars\ntarget_radius: 0.2\n";
  text += "bounds: [0, 0, " + side + ", " + side + "]\ncircles: [\n";
  for (const core::Vec2& pillar : pillars_in(side_m)) {
    text += "  [" + std::to_string(pillar.x()) + ", " + std::to_string(pillar.y()) + ", " +
            std::to_string(kPillar_m) + "],\n";
  }
  text += "]\nstart: [" + std::to_string(side_m / 2 - 7) + ", " + middle + ", 0]\ntarget: [" +
          std::to_string(side_m / 2 + 7) + ", " + middle + "]\n";
  return world::World::parse(text, "pillars.yaml").value();
}

/// An empty field, and a target so far away.
world::World empty_field(int distance_m) {
  const std::string text = "format: clew-world/1\nname: empty\nabout: empty\nbounds: [0, 0, " +
                           std::to_string(distance_m + 20) +
                           ", 20]\ntarget_radius: 0.2\nstart: [10, 10, 0]\ntarget: [" +
                           std::to_string(distance_m + 10) + ", 10]\n";
  return world::World::parse(text, "empty.yaml").value();
}

/// All of that field: free, but for the rims of its pillars.
map::SeenMap::State seen_whole(int side_m) {
  const map::LocalMapParameters parameters;
  map::SeenMap seen(parameters.cell_m, 1 << 16);
  for (int x = 0; x < side_m; ++x) {
    for (int y = 0; y < side_m; ++y) seen.mark_free(map::Sector({x + 0.5, y + 0.5}, 0.75));
  }
  for (const core::Vec2& pillar : pillars_in(side_m)) {
    for (int i = 0; i < 90; ++i) {
      seen.mark_hit(pillar + kPillar_m * core::direction(core::radians(4.0 * i)));
    }
  }
  return seen.state();
}

/// Leads a robot through the world, and times each tick.
template <typename EscapeKind>
std::vector<double> times_of_trip_us(const world::World& world, double& path_m,
                                     const map::SeenMap::State& seen = {},
                                     std::size_t most_ticks = kMostTicks) {
  domain::BehaviourSetup setup;
  setup.tick_s = kTick_s;
  setup.limits.speed_mps = 0.5;
  sense::Laser::Parameters laser;
  laser.range_m = 4.0;
  const sense::Laser sensor(laser, setup.robot.radius_m);
  const auto escape = EscapeKind::create({}, setup).value();
  map::LocalMapParameters parameters;
  parameters.capacity_tiles = 1 << 16;
  map::LocalMap local_map(parameters, setup.robot.radius_m);
  local_map.restore(seen);
  domain::Odometry odometry;
  odometry.pose_odom_robot = world.start();
  domain::Scan scan;
  std::vector<double> times_us;
  bool begun = false;
  while (times_us.size() < most_ticks) {
    const std::uint64_t tick = times_us.size();
    core::Pose2& pose = odometry.pose_odom_robot;
    sensor.measure(world, pose, 0.0, core::Random({1, 0, 1, tick}), scan);
    const Situation situation{
        tick,      odometry, scan, nullptr, world.target(), world.target(), world.target_radius_m(),
        &local_map};
    if (situation.target_distance_m() <= world.target_radius_m()) break;
    domain::Guidance guidance;
    const double before_us = processor_time_us();
    local_map.see(odometry, scan);
    if (!begun) escape->begin(situation, {});
    begun = escape->step(situation, guidance) == EscapeStatus::kActive;
    times_us.push_back(processor_time_us() - before_us);
    const domain::Motion& motion = guidance.override_motion;
    const core::Vec2 goal = begun ? core::Vec2(pose.position()) : world.target();
    pose.heading_rad = begun ? core::wrap_angle_rad(pose.heading_rad + motion.turn_rad)
                             : core::atan2(goal.y() - pose.y_m, goal.x() - pose.x_m);
    const double step_m = begun ? motion.step_m : 0.15;
    pose.x_m += step_m * core::cos(pose.heading_rad);
    pose.y_m += step_m * core::sin(pose.heading_rad);
    path_m += step_m;
  }
  return times_us;
}

/// Sets what the times of ticks were: their mean, and the time that one in a hundred exceeds.
void count(benchmark::State& state, std::vector<double> times_us) {
  std::sort(times_us.begin(), times_us.end());
  double sum_us = 0.0;
  for (const double time_us : times_us) sum_us += time_us;
  state.counters["mean_us"] = sum_us / static_cast<double>(times_us.size());
  state.counters["p99_us"] = times_us[times_us.size() * 99 / 100];
}

template <typename EscapeKind>
void trip(benchmark::State& state, const char* world_name) {
  const world::World world = world_of(world_name);
  std::vector<double> times_us;
  double path_m = 0.0;
  for (auto _ : state) {
    path_m = 0.0;
    const auto trip_us = times_of_trip_us<EscapeKind>(world, path_m);
    times_us.insert(times_us.end(), trip_us.begin(), trip_us.end());
  }
  count(state, times_us);
  state.counters["path_m"] = path_m;
}

// In a world so wide that was seen whole. The first tick takes in all of it at once, as after a
// load; it is told apart.
void remembered_map_seen_whole(benchmark::State& state) {
  const auto side_m = static_cast<int>(state.range(0));
  const world::World world = field_of_pillars(side_m);
  const map::SeenMap::State seen = seen_whole(side_m);
  std::vector<double> times_us;
  double path_m = 0.0;
  double first_us = 0.0;
  for (auto _ : state) {
    const auto trip_us = times_of_trip_us<RememberedMap>(world, path_m, seen);
    first_us = trip_us.front();
    times_us.insert(times_us.end(), trip_us.begin() + 1, trip_us.end());
  }
  count(state, times_us);
  state.counters["first_us"] = first_us;
}

// The first 100 ticks towards a target so far away, where nothing is.
void remembered_map_in_the_open(benchmark::State& state) {
  const world::World world = empty_field(static_cast<int>(state.range(0)));
  std::vector<double> times_us;
  double path_m = 0.0;
  for (auto _ : state) {
    const auto trip_us = times_of_trip_us<RememberedMap>(world, path_m, {}, 100);
    times_us.insert(times_us.end(), trip_us.begin(), trip_us.end());
  }
  count(state, times_us);
}

void remembered_map(benchmark::State& state, const char* world_name) {
  trip<RememberedMap>(state, world_name);
}
void remembered_astar(benchmark::State& state, const char* world_name) {
  trip<RememberedAStar>(state, world_name);
}
BENCHMARK_CAPTURE(remembered_map, office, "office");
BENCHMARK_CAPTURE(remembered_astar, office, "office");
BENCHMARK_CAPTURE(remembered_map, maze_16x16, "maze-16x16");
BENCHMARK_CAPTURE(remembered_astar, maze_16x16, "maze-16x16");
BENCHMARK_CAPTURE(remembered_map, bug_trap, "bug-trap");
BENCHMARK_CAPTURE(remembered_astar, bug_trap, "bug-trap");
BENCHMARK(remembered_map_seen_whole)->Arg(20)->Arg(200);
BENCHMARK(remembered_map_in_the_open)->Arg(20)->Arg(1000);

}  // namespace
}  // namespace clew::recover

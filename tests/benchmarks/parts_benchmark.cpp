// SPDX-License-Identifier: Apache-2.0
/// What a tick of a sensor or a controller costs, at poses in a shipped world.
#include <benchmark/benchmark.h>

#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "control/behaviourist/fuzzy_behaviourist.hpp"
#include "control/gaps/nearest_virtual_target.hpp"
#include "control/infrared/neuro_fuzzy.hpp"
#include "control/polar/polar_neural_map.hpp"
#include "sense/infrared.hpp"
#include "sense/laser.hpp"
#include "sense/sonar_ring.hpp"
#include "tests/source_path.hpp"

namespace clew {
namespace {

constexpr double kRadius_m = 0.15;
constexpr std::size_t kPoses = 256;

core::Resource file_of(const std::string& path) {
  std::ifstream stream(tests::source_path(path), std::ios::binary);
  return {path, {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()}};
}

world::World world_of(const std::string& name) {
  const core::Resource file = file_of("configs/worlds/" + name + ".yaml");
  return world::World::parse(file.text, file.file).value();
}

std::vector<core::Pose2> poses_in(const world::World& world) {
  const core::Random random({1, 0, 0, 0});
  const core::Vec2 size = world.bounds_max() - world.bounds_min();
  std::vector<core::Pose2> poses;
  for (std::uint32_t i = 0; poses.size() < kPoses; i += 3) {
    const core::Vec2 at = world.bounds_min() + core::Vec2(random.uniform(i) * size.x(),
                                                          random.uniform(i + 1) * size.y());
    if (world.clearance_m(at, 1.0, 0.0) < kRadius_m) continue;
    poses.push_back({at.x(), at.y(), core::kPi * (2.0 * random.uniform(i + 2) - 1.0)});
  }
  return poses;
}

template <typename Sensor>
void measure(benchmark::State& state, const char* world_name, double noise_stddev_m) {
  typename Sensor::Parameters parameters;
  parameters.noise.stddev_m = noise_stddev_m;
  const Sensor sensor(parameters, kRadius_m);
  const world::World world = world_of(world_name);
  const auto poses = poses_in(world);
  domain::Scan scan;
  std::uint64_t tick = 0;
  for (auto _ : state) {
    sensor.measure(world, poses[tick % kPoses], 0.0, core::Random({1, 0, 1, tick}), scan);
    benchmark::DoNotOptimize(scan.ranges_m.data());
    ++tick;
  }
  state.SetItemsProcessed(state.iterations());
}

void laser(benchmark::State& state, const char* world_name, double noise_stddev_m) {
  measure<sense::Laser>(state, world_name, noise_stddev_m);
}
BENCHMARK_CAPTURE(laser, u_trap, "u-trap", 0.0);
BENCHMARK_CAPTURE(laser, forest, "forest", 0.0);
BENCHMARK_CAPTURE(laser, maze_16x16, "maze-16x16", 0.0);
BENCHMARK_CAPTURE(laser, maze_16x16_noisy, "maze-16x16", 0.01);

void sonar_ring(benchmark::State& state, const char* world_name) {
  measure<sense::SonarRing>(state, world_name, 0.0);
}
BENCHMARK_CAPTURE(sonar_ring, maze_16x16, "maze-16x16");

/// A controller on scans of a sensor at the poses, toward the world's target.
template <typename Sensor>
void control(benchmark::State& state, control::Controller& controller) {
  const Sensor sensor({}, kRadius_m);
  const world::World world = world_of("forest");
  const auto poses = poses_in(world);
  std::vector<domain::Scan> scans(kPoses);
  for (std::size_t i = 0; i < kPoses; ++i) {
    sensor.measure(world, poses[i], 0.0, core::Random({1, 0, 1, i}), scans[i]);
  }
  domain::Odometry odometry;
  std::size_t i = 0;
  for (auto _ : state) {
    odometry.pose_odom_robot = poses[i];
    benchmark::DoNotOptimize(controller.step(odometry, scans[i], world.target()));
    i = (i + 1) % kPoses;
  }
  state.SetItemsProcessed(state.iterations());
}

void nearest_virtual_target_on_361_beams(benchmark::State& state) {
  control::NearestVirtualTarget controller(
      {},
      control::VirtualTargetRules::parse(file_of("configs/rulebases/nakhaeinia_nvt.yaml")).value(),
      kRadius_m, 0.1);
  control<sense::Laser>(state, controller);
}
BENCHMARK(nearest_virtual_target_on_361_beams);

void fuzzy_behaviourist_on_16_sonars(benchmark::State& state) {
  control::FuzzyBehaviourist controller(
      control::BehaviouristRules::parse(file_of("configs/rulebases/pin_bender_fba.yaml")).value());
  control<sense::SonarRing>(state, controller);
}
BENCHMARK(fuzzy_behaviourist_on_16_sonars);

control::NeuroFuzzyNets trained_nets() {
  return control::NeuroFuzzyNets::parse(file_of("configs/rulebases/wang_yang_meng_trained.yaml"))
      .value();
}

void neuro_fuzzy_on_4_infrareds(benchmark::State& state) {
  const sense::Infrared sensor({}, kRadius_m);
  control::NeuroFuzzy controller(
      trained_nets(), {}, control::FourInfrareds::create(sensor.layout(), "benchmark").value());
  control<sense::Infrared>(state, controller);
}
BENCHMARK(neuro_fuzzy_on_4_infrareds);

/// What a network's share of a training iteration is, less the step itself.
void neuro_fuzzy_gradient(benchmark::State& state) {
  const auto nets = trained_nets();
  const auto& net = nets.nets[control::NeuroFuzzyNets::kLeft2];
  double reading = 45.0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(net.gradient(reading, 225.0 - reading));
    reading = reading < 180.0 ? reading + 1.0 : 45.0;
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(neuro_fuzzy_gradient);

/// A cycle in the middle of a drive past pillars, ten scans in memory, at a pace of 0.4 m/s;
/// sensing is not in it.
template <typename Sensor>
void polar_neural_map(benchmark::State& state, std::int64_t rings, std::int64_t sectors) {
  const Sensor sensor({}, kRadius_m);
  const world::World world = world_of("lm-fig08-clutter");
  domain::BehaviourSetup setup;
  setup.tick_s = 0.1;
  setup.robot.radius_m = kRadius_m;
  setup.scan = sensor.layout();
  control::PolarNeuralMap::Parameters parameters;
  parameters.rings = rings;
  parameters.sectors = sectors;
  control::PolarNeuralMap controller(parameters, setup);
  constexpr std::size_t kTicks = 50;  // 2 m from the start, past the first two blocks
  std::vector<domain::Scan> scans(kTicks);
  std::vector<domain::Odometry> odometries(kTicks);
  for (std::size_t i = 0; i < kTicks; ++i) {
    odometries[i].pose_odom_robot = {0.8 + 0.04 * static_cast<double>(i), 3.1, 0.0};
    odometries[i].speed_mps = 0.4;
    sensor.measure(world, odometries[i].pose_odom_robot, 0.0, core::Random({1, 0, 1, i}), scans[i]);
  }
  std::uint64_t tick = 0;
  for (auto _ : state) {
    const std::size_t i = tick % kTicks;
    odometries[i].stamp.sim_time_s = 0.1 * static_cast<double>(++tick);
    benchmark::DoNotOptimize(controller.step(odometries[i], scans[i], world.target()));
  }
  state.SetItemsProcessed(state.iterations());
}

void polar_neural_map_on_16_sonars(benchmark::State& state) {
  polar_neural_map<sense::SonarRing>(state, state.range(0), state.range(1));
}
BENCHMARK(polar_neural_map_on_16_sonars)->Args({10, 32})->Args({100, 32})->Args({100, 48});

void polar_neural_map_on_361_beams(benchmark::State& state) {
  polar_neural_map<sense::Laser>(state, state.range(0), state.range(1));
}
BENCHMARK(polar_neural_map_on_361_beams)->Args({100, 48});

}  // namespace
}  // namespace clew

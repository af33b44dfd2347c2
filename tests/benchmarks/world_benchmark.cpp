// SPDX-License-Identifier: Apache-2.0
/// What the world's queries cost, against the number of walls. A scan is Krishna & Kalra's: seven
/// cones of 15 degrees, 15 degrees apart, that see 1.65 m from the robot's centre.

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/random.hpp"
#include "tests/source_path.hpp"
#include "world/world.hpp"

namespace clew::world {
namespace {

using core::radians;

constexpr int kCones = 7;
constexpr double kRange_m = 1.65;
constexpr double kRadius_m = 0.15;

std::array<ConeDirection, kCones> cones_of_the_robot() {
  std::array<ConeDirection, kCones> cones;
  for (int i = 0; i < kCones; ++i) {
    cones[static_cast<std::size_t>(i)] = ConeDirection::of(radians(45.0 - 15.0 * i), radians(7.5));
  }
  return cones;
}

// Walls about as long as they are apart: more walls in the same size are a finer drawing.
std::string walls_yaml(std::int64_t count, double size_m) {
  const core::Random random(core::RandomKey{1, 0, 0, 0});
  std::uint32_t next = 0;
  const auto between = [&](double low, double high) {
    return low + (high - low) * random.uniform(next++);
  };
  std::string yaml = fmt::format(
      "format: clew-world/1\nname: walls\nbounds: [0, 0, {0}, {0}]\nstart: [0.5, 0.5, 0]\n"
      "target: [{1}, {1}]\ntarget_radius: 0.2\nwalls: [\n",
      size_m, size_m - 0.5);
  const double half_m = 0.5 * (size_m - 2.0) / std::sqrt(static_cast<double>(count));
  for (std::int64_t i = 0; i < count; ++i) {
    const double x = between(1.0, size_m - 1.0);
    const double y = between(1.0, size_m - 1.0);
    yaml += fmt::format("  [{:.3f}, {:.3f}, {:.3f}, {:.3f}],\n", x, y, x + between(-half_m, half_m),
                        y + between(-half_m, half_m));
  }
  return yaml + "]\n";
}

// At one wall a square metre, as many as in the shipped worlds.
double size_at_constant_density_m(std::int64_t count) {
  return 2.0 + std::sqrt(static_cast<double>(count));
}
constexpr double kFixedSize_m = 32.0;

const World& world_of_walls(std::int64_t count, double size_m) {
  static std::map<std::pair<std::int64_t, double>, World> worlds;
  const auto found = worlds.find({count, size_m});
  if (found != worlds.end()) return found->second;
  World world = *World::parse(walls_yaml(count, size_m), "walls.yaml");
  return worlds.emplace(std::make_pair(count, size_m), std::move(world)).first->second;
}

// Free poses all over the world.
std::vector<Pose2> poses_in(const World& world) {
  const core::Random random(core::RandomKey{2, 0, 0, 0});
  std::vector<Pose2> poses;
  const Vec2 size = world.bounds_max() - world.bounds_min();
  for (std::uint32_t i = 0; poses.size() < 1000 && i < 100000; i += 3) {
    const Vec2 at =
        world.bounds_min() + Vec2(random.uniform(i) * size.x(), random.uniform(i + 1) * size.y());
    if (world.clearance_m(at, 1.0, 0.0) > 0.0) {
      poses.push_back({at.x(), at.y(), 2.0 * core::kPi * random.uniform(i + 2)});
    }
  }
  return poses;
}

void scan(benchmark::State& state, const World& world) {
  const auto poses = poses_in(world);
  const auto cones = cones_of_the_robot();
  std::size_t i = 0;
  for (auto _ : state) {
    const Pose2& pose = poses[i++ % poses.size()];
    const Vec2 heading = core::direction(pose.heading_rad);
    for (const ConeDirection& cone : cones) {
      benchmark::DoNotOptimize(
          world.cone_distance_m(pose.position(), cone.turned(heading), kRange_m, 0.0));
    }
  }
  state.SetItemsProcessed(state.iterations() * kCones);  // items are cones
}

void scan_at_constant_density(benchmark::State& state) {
  scan(state, world_of_walls(state.range(0), size_at_constant_density_m(state.range(0))));
}
BENCHMARK(scan_at_constant_density)->RangeMultiplier(10)->Range(10, 100000);

void scan_in_a_world_of_32_m(benchmark::State& state) {
  scan(state, world_of_walls(state.range(0), kFixedSize_m));
}
BENCHMARK(scan_in_a_world_of_32_m)->RangeMultiplier(10)->Range(10, 100000);

void scan_shipped(benchmark::State& state, const char* name) {
  std::ifstream stream(tests::source_path(fmt::format("configs/worlds/{}.yaml", name)));
  const std::string yaml{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  const World world = *World::parse(yaml, name);
  scan(state, world);
}
BENCHMARK_CAPTURE(scan_shipped, u_trap, "u-trap");
BENCHMARK_CAPTURE(scan_shipped, forest, "forest");
BENCHMARK_CAPTURE(scan_shipped, maze_16x16, "maze-16x16");
BENCHMARK_CAPTURE(scan_shipped, walking_people, "lm-text-walking-people");

void sweep_at_constant_density(benchmark::State& state) {
  const World& world = world_of_walls(state.range(0), size_at_constant_density_m(state.range(0)));
  const auto poses = poses_in(world);
  std::size_t i = 0;
  for (auto _ : state) {
    const Pose2& pose = poses[i++ % poses.size()];
    const Vec2 to = pose.position() + 0.15 * core::direction(pose.heading_rad);
    benchmark::DoNotOptimize(world.sweep_disc(pose.position(), to, kRadius_m, 0.0, 0.3));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(sweep_at_constant_density)->RangeMultiplier(10)->Range(10, 100000);

void load(benchmark::State& state) {
  const std::string yaml = walls_yaml(state.range(0), size_at_constant_density_m(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(World::parse(yaml, "walls.yaml"));
  state.SetItemsProcessed(state.iterations() * state.range(0));  // items are walls
}
BENCHMARK(load)->RangeMultiplier(10)->Range(10, 100000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace clew::world

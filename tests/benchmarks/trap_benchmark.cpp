// SPDX-License-Identifier: Apache-2.0
/// What noticing a trap costs in a tick: a look-up among as many positions as were ever visited,
/// and the gaps of a laser's scan.

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>

#include "core/random.hpp"
#include "recover/detectors/no_safe_region.hpp"
#include "recover/detectors/position_memory.hpp"
#include "recover/detectors/position_revisit.hpp"

namespace clew::recover {
namespace {

/// A position of a way that sweeps a field in rows 0.5 m apart, 0.1 m a step; a row is 1000 m.
core::Pose2 on_the_way(std::uint64_t step) {
  constexpr std::uint64_t kRow = 10000;
  const double along_m = 0.1 * static_cast<double>(step % kRow);
  return {along_m, 0.5 * static_cast<double>(step / kRow), 0.0};
}

// One look at the nine cells around a position, when `range` positions have been visited.
void look_up_among(benchmark::State& state) {
  const auto positions = static_cast<std::uint64_t>(state.range(0));
  PositionMemory memory(0.5, 1 << 20);
  for (std::uint64_t i = 0; i < positions; ++i) {
    memory.add({i, on_the_way(i), 0.1 * static_cast<double>(i), {}});
  }
  const core::Random random(core::RandomKey{1, 0, 0, 0});
  std::uint32_t next = 0;
  for (auto _ : state) {
    const auto step =
        static_cast<std::uint64_t>(random.uniform(next++) * static_cast<double>(positions));
    std::uint64_t seen = 0;
    memory.around(on_the_way(step).position(), 1, [&](const PositionMemory::Visit&) { ++seen; });
    benchmark::DoNotOptimize(seen);
  }
  state.counters["cells"] = static_cast<double>(memory.size());
}
BENCHMARK(look_up_among)->RangeMultiplier(10)->Range(1000, 1000000);

// A tick of the detector at the end of a way of `range` positions.
void position_revisit_after(benchmark::State& state) {
  PositionRevisitParameters parameters;
  parameters.capacity = 1 << 20;
  PositionRevisit detector(parameters);
  domain::Odometry odometry;
  const domain::Scan scan;
  std::uint64_t step = 0;
  const auto tick = [&] {
    odometry.pose_odom_robot = on_the_way(step);
    odometry.travel_m = 0.1 * static_cast<double>(step);
    const Situation situation{step, odometry, scan, nullptr, {0, 0}, {0, 0}};
    ++step;
    return detector.observe(situation).has_value();
  };
  while (step < static_cast<std::uint64_t>(state.range(0))) tick();
  for (auto _ : state) benchmark::DoNotOptimize(tick());
}
BENCHMARK(position_revisit_after)->RangeMultiplier(10)->Range(1000, 1000000);

// A tick of no_safe_region on a laser's 361 beams over 180 degrees, all of which meet something.
void no_safe_region_on_361_beams(benchmark::State& state) {
  NoSafeRegion detector({}, 0.15);
  domain::Odometry odometry;
  domain::Scan scan;
  scan.bearing_first_rad = core::radians(-90.0);
  scan.bearing_step_rad = core::radians(0.5);
  scan.range_max_m = 2.0;
  const core::Random random(core::RandomKey{2, 0, 0, 0});
  for (std::uint32_t i = 0; i < 361; ++i) scan.ranges_m.push_back(0.3 + 0.2 * random.uniform(i));
  std::uint64_t tick = 0;
  for (auto _ : state) {
    const Situation situation{tick++, odometry, scan, nullptr, {10, 0}, {10, 0}};
    benchmark::DoNotOptimize(detector.observe(situation).has_value());
  }
}
BENCHMARK(no_safe_region_on_361_beams)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace clew::recover

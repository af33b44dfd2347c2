// SPDX-License-Identifier: Apache-2.0
/// The neural map against other ways to plan on the same cells: one cell in five blocked, from
/// corner to corner. `cells/s` is the rate over all cells of the grid, which tells whether the time
/// grows with their number.

#include <benchmark/benchmark.h>

#include <optional>
#include <vector>

#include "core/check.hpp"
#include "core/random.hpp"
#include "map/neural_map.hpp"
#include "path_methods/grid_methods.hpp"

namespace clew::path_methods {
namespace {

Task task_of(const benchmark::State& state) {
  const auto columns = static_cast<std::int32_t>(state.range(0));
  const auto rows = static_cast<std::int32_t>(state.range(1));
  Task task{{{0.0, 0.0}, 1.0, columns, rows}, {}, {2, 2}, {columns - 3, rows - 3}};
  const core::Random random({1, 0, 0, 0});
  for (std::uint32_t i = 0; i < task.grid.size(); ++i) {
    task.passable.push_back(random.uniform(i) < 0.2 ? 0 : 1);
  }
  for (const Cell& end : {task.start, task.target}) task.passable[task.grid.index(end)] = 1;
  return task;
}

void count_cells(benchmark::State& state) {
  state.counters["cells/s"] =
      benchmark::Counter(static_cast<double>(state.range(0) * state.range(1)),
                         benchmark::Counter::kIsIterationInvariantRate);
}

void spread(benchmark::State& state, bool early) {
  const Task task = task_of(state);
  auto landscape = map::NeuralMap::create({}).value();
  const auto start = early ? std::optional<Cell>(task.start) : std::nullopt;
  std::vector<Cell> path;
  int patterns = 0;
  for (auto _ : state) {
    patterns = landscape.evolve(task.grid, task.passable, {task.target}, start).patterns;
    CLEW_CHECK(landscape.path(task.start, path), "no way");
  }
  state.counters["patterns"] = patterns;
  count_cells(state);
}

void neural_map_early_stop(benchmark::State& state) { spread(state, true); }
void neural_map_at_rest(benchmark::State& state) { spread(state, false); }

void dijkstra_heap(benchmark::State& state) {
  const Task task = task_of(state);
  std::vector<double> lengths;
  for (auto _ : state) dijkstra(task, true, lengths);
  count_cells(state);
}

void distance_transform_wave(benchmark::State& state) {
  const Task task = task_of(state);
  std::vector<double> steps;
  for (auto _ : state) distance_transform(task, steps);
  count_cells(state);
}

// Over-relaxation amplifies roundings by about half the longer side over pi: at 4096 to
// some 1.5e-13 of what comes to rest at 1, below which changes would never fall.
constexpr double kHarmonicRest = 1e-12;

void harmonic_sor(benchmark::State& state) {
  const Task task = task_of(state);
  std::vector<double> potential;
  int sweeps = 0;
  for (auto _ : state) sweeps = harmonic(task, kHarmonicRest, potential);
  state.counters["sweeps"] = sweeps;
  count_cells(state);
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->Args({50, 50})->Args({500, 500})->Args({1000, 500})->Unit(benchmark::kMillisecond);
}
void all_sizes(benchmark::internal::Benchmark* benchmark) {
  sizes(benchmark);
  benchmark->Args({4096, 4096});
}

BENCHMARK(neural_map_early_stop)->Apply(all_sizes);
BENCHMARK(dijkstra_heap)->Apply(all_sizes);
BENCHMARK(distance_transform_wave)->Apply(all_sizes);
BENCHMARK(neural_map_at_rest)->Apply(all_sizes);
BENCHMARK(harmonic_sor)->Apply(sizes);

}  // namespace
}  // namespace clew::path_methods

// SPDX-License-Identifier: Apache-2.0
/// Prints a table in Markdown that compares the neural map's paths with other methods', for
/// docs/notes/plan.md: over the shipped worlds in which nothing moves and the target can be
/// reached, on cells of 0.1 m.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "map/neural_map.hpp"
#include "map/smooth_path.hpp"
#include "path_methods/grid_methods.hpp"
#include "path_methods/path_measures.hpp"
#include "plan/known_map.hpp"
#include "runtime/config_source.hpp"
#include "world/world.hpp"

namespace clew::path_methods {
namespace {

constexpr double kCell_m = 0.1;
constexpr double kRadius_m = 0.15;
constexpr double kTolerance = 1e-14;

struct Scene {
  Task task;
  double shortest_in_plane_m = 0.0;
  double shortest_on_lattice_m = 0.0;
};

using Path = std::vector<Vec2>;

/// A method by name: the path through a scene, empty if it finds none.
struct Method {
  std::string name;
  std::function<Path(const Task&)> find;
};

Path middles(const Task& task, const std::vector<Cell>& cells) {
  Path path;
  for (const Cell& cell : cells) path.push_back(task.grid.centre(cell));
  return path;
}

Path descend(const Task& task, const std::vector<double>& heights) {
  std::vector<Cell> cells;
  return descent(task, heights, cells) ? middles(task, cells) : Path();
}

enum class Ending { kEarly, kAtRest };

Path ascend(const Task& task, Ending ending, bool smooth) {
  auto landscape = map::NeuralMap::create({}).value();
  const auto start = ending == Ending::kEarly ? std::optional<Cell>(task.start) : std::nullopt;
  landscape.evolve(task.grid, task.passable, {task.target}, start);
  Path places;
  std::vector<Cell> cells;
  if (smooth) {
    map::smooth_path(landscape, task.start, places);
  } else if (landscape.path(task.start, cells)) {
    places = middles(task, cells);
  }
  return places;
}

std::vector<Method> methods() {
  return {
      {"neural map, early stop", [](const Task& t) { return ascend(t, Ending::kEarly, false); }},
      {"neural map, at rest", [](const Task& t) { return ascend(t, Ending::kAtRest, false); }},
      {"neural map, early stop, smooth",
       [](const Task& t) { return ascend(t, Ending::kEarly, true); }},
      {"neural map, at rest, smooth",
       [](const Task& t) { return ascend(t, Ending::kAtRest, true); }},
      {"Dijkstra",
       [](const Task& t) {
         std::vector<double> lengths;
         dijkstra(t, true, lengths);
         return descend(t, lengths);
       }},
      {"distance transform",
       [](const Task& t) {
         std::vector<double> steps;
         distance_transform(t, steps);
         return descend(t, steps);
       }},
      {"harmonic function", [](const Task& t) {
         std::vector<double> potential;
         harmonic(t, kTolerance, potential);
         return descend(t, potential);
       }}};
}

/// The scene of a world; none if something moves in it, or the lattice has no way.
std::optional<Scene> scene_of(const core::Resource& file) {
  auto read = world::World::parse(file.text, file.file);
  if (!read.ok() || !read->moving().empty() || !read->shortest_path_m().has_value()) return {};
  const auto world = std::make_shared<const world::World>(std::move(read).value());
  const auto source = plan::WorldMap::create(world, kCell_m, {kRadius_m, 0.0});
  if (!source.ok()) return {};
  const plan::RoomView room = (*source)->read(world->start().position(), world->target());
  Scene scene;
  scene.task.grid = room.grid;
  for (const map::Clearance cell : room.room)
    scene.task.passable.push_back(cell == map::Clearance::kOpen);
  scene.task.start = *room.grid.cell_at(world->start().position());
  scene.task.target = *room.grid.cell_at(world->target());
  for (const Cell& end : {scene.task.start, scene.task.target}) {
    if (scene.task.passable[room.grid.index(end)] == 0) return {};
  }
  std::vector<double> lengths;
  dijkstra(scene.task, true, lengths);
  scene.shortest_on_lattice_m = kCell_m * lengths[room.grid.index(scene.task.start)];
  scene.shortest_in_plane_m = *world->shortest_path_m();
  if (scene.shortest_on_lattice_m > 1e6) return {};
  return scene;
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

void print_row(const Method& method, const std::vector<Scene>& scenes) {
  std::vector<double> to_lattice;
  std::vector<double> to_plane;
  std::vector<double> turning_rad2;
  double time_ms = 0.0;
  for (const Scene& scene : scenes) {
    const auto begin = std::chrono::steady_clock::now();
    const Path path = method.find(scene.task);
    time_ms +=
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    if (path.empty()) continue;
    to_lattice.push_back(length_m(path) / scene.shortest_on_lattice_m);
    to_plane.push_back(length_m(path) / scene.shortest_in_plane_m);
    turning_rad2.push_back(squared_turning_rad2(path, kCell_m));
  }
  fmt::print("| {} | {} | {:.3f} | {:.3f} | {:.3f} | {:.1f} | {:.1f} |\n", method.name,
             to_lattice.size(), quantile(to_lattice, 0.5), quantile(to_lattice, 1.0),
             quantile(to_plane, 0.5), quantile(turning_rad2, 0.5),
             time_ms / static_cast<double>(scenes.size()));
}

int run() {
  const auto configs = runtime::ConfigPath::from_environment();
  std::vector<Scene> scenes;
  for (const std::string& name : configs.names("worlds")) {
    const auto file = configs.find("worlds", name);
    if (!file.ok()) continue;
    if (auto scene = scene_of(*file)) scenes.push_back(std::move(*scene));
  }
  fmt::print(
      "| of {} worlds | ways found | length / shortest on the lattice, median | longest | "
      "length / shortest in the plane, median | squared turning, median, rad^2 | time, "
      "mean, ms |\n|---|---|---|---|---|---|---|\n",
      scenes.size());
  for (const Method& method : methods()) print_row(method, scenes);
  return 0;
}

}  // namespace
}  // namespace clew::path_methods

int main(int argc, char** argv) {
  if (argc > 1) {
    fmt::print(stderr, "path-table: found '{}'; it takes no arguments\n", argv[1]);
    return 2;
  }
  return clew::path_methods::run();
}

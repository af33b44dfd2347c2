// SPDX-License-Identifier: Apache-2.0
#include "bench/barn.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <system_error>
#include <utility>

#include "bench/statistics.hpp"
#include "world/world.hpp"
#include "world_import/npy_path.hpp"
#include "world_import/world_import.hpp"

namespace clew::bench {
namespace {

using core::Error;
using core::Result;

namespace fs = std::filesystem;

constexpr char kPathFolder[] = "path_files";
constexpr double kOptimalSpeed_mps = 2.0;
constexpr double kTimeLimit_s = 100.0;
constexpr double kMostTimes = 8.0;
constexpr double kLeastTimes = 2.0;
constexpr double kLeastTimes2022 = 4.0;

/// N of `world_N.world`.
std::optional<unsigned> number_of(const fs::path& path) {
  const std::string stem = path.stem().string();
  const std::string prefix = "world_";
  if (path.extension() != ".world" || stem.rfind(prefix, 0) != 0) return std::nullopt;
  unsigned number = 0;
  const char* const end = stem.data() + stem.size();
  const auto [stop, error] = std::from_chars(stem.data() + prefix.size(), end, number);
  if (error != std::errc() || stop != end) return std::nullopt;
  return number;
}

Result<std::map<unsigned, fs::path>> worlds_in(const std::string& directory) {
  std::map<unsigned, fs::path> worlds;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(directory, error)) {
    if (const auto number = number_of(entry.path())) worlds[*number] = entry.path();
  }
  if (error) return Error{"cannot be read: " + error.message(), directory};
  if (worlds.empty()) {
    return Error{"has no world of BARN; expected world_N.world and path_N.npy", directory};
  }
  return worlds;
}

Result<fs::path> path_of(const fs::path& world, unsigned number) {
  const std::string name = fmt::format("path_{}.npy", number);
  std::error_code error;
  for (const fs::path& path :
       {world.parent_path() / name, world.parent_path() / kPathFolder / name}) {
    if (fs::exists(path, error)) return path;
  }
  return Error{
      fmt::format("has no {} beside it nor in {}: the score needs its length", name, kPathFolder),
      world.string()};
}

Result<BarnWorld> read_world(const fs::path& path, unsigned number) {
  const auto cells_path = path_of(path, number);
  if (!cells_path.ok()) return cells_path.error();
  const auto cells = world_import::read_npy_points(cells_path->string());
  if (!cells.ok()) return cells.error();
  auto text = world_import::import_world(path.string(), {});
  if (!text.ok()) return text.error();
  const auto world = world::World::parse(*text, path.string());
  if (!world.ok()) return world.error();
  // The program's path begins at the start and ends at the goal.
  std::vector<core::Vec2> places = {world->start().position()};
  for (const core::Vec2& place : world_import::barn_path_places(*cells)) places.push_back(place);
  places.push_back(world->target());
  return BarnWorld{fmt::format("barn-{}", number), std::move(text).value(),
                   world_import::length_m(places)};
}

double score(bool arrived, double time_s, double optimal_s, double least) {
  if (!arrived) return 0.0;
  return optimal_s / std::clamp(time_s, least * optimal_s, kMostTimes * optimal_s);
}

template <typename Value>
std::string mean(const std::vector<const RunResult*>& runs, const Value& value) {
  double sum = 0.0;
  for (const RunResult* run : runs) sum += value(*run->barn);
  return fmt::format("{:.4f}", sum / static_cast<double>(runs.size()));
}

}  // namespace

Result<std::vector<BarnWorld>> read_barn(const std::string& directory) {
  const auto paths = worlds_in(directory);
  if (!paths.ok()) return paths.error();
  std::vector<BarnWorld> worlds;
  for (const auto& [number, path] : *paths) {
    auto world = read_world(path, number);
    if (!world.ok()) return world.error();
    worlds.push_back(std::move(world).value());
  }
  return worlds;
}

BarnScore barn_score(bool reached, double time_s, double path_m) {
  const double optimal_s = path_m / kOptimalSpeed_mps;
  const bool arrived = reached && time_s < kTimeLimit_s;
  return {arrived, optimal_s, score(arrived, time_s, optimal_s, kLeastTimes),
          score(arrived, time_s, optimal_s, kLeastTimes2022)};
}

Table barn_table(const BenchResults& results) {
  Table table;
  table.title = "BARN's score";
  table.note =
      "OT / clip(AT, 2 OT, 8 OT) of a run that arrives within 100 s, else 0; 0.5 is the best. OT "
      "is "
      "the time for BARN's own path at 2 m/s, AT the time taken. In 2022 the least was 4 OT, and "
      "0.25 the best.";
  table.columns = {"graph", "runs", "score", "score of 2022", "arrived", "collided"};
  for (std::size_t i = 0; i < results.plan->variants.size(); ++i) {
    std::vector<const RunResult*> runs;
    for (const RunResult* run : results.samples_of(i)) {
      if (run->barn) runs.push_back(run);
    }
    if (runs.empty()) continue;
    const auto count = [&](auto condition) {
      return static_cast<std::size_t>(std::count_if(runs.begin(), runs.end(), condition));
    };
    const std::size_t arrived = count([](const RunResult* run) { return run->barn->arrived; });
    const std::size_t collided = count([](const RunResult* run) { return run->collisions > 0; });
    table.rows.push_back({results.plan->variants[i].label(), std::to_string(runs.size()),
                          mean(runs, [](const BarnScore& barn) { return barn.score; }),
                          mean(runs, [](const BarnScore& barn) { return barn.score_2022; }),
                          share_text(arrived, runs.size()), std::to_string(collided)});
  }
  return table;
}

}  // namespace clew::bench

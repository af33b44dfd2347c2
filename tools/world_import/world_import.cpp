// SPDX-License-Identifier: Apache-2.0
#include "world_import/world_import.hpp"

#include <fmt/format.h>

#include <cctype>
#include <filesystem>
#include <regex>
#include <system_error>
#include <utility>

#include "core/math.hpp"
#include "world/world.hpp"
#include "world_import/cell_world.hpp"
#include "world_import/free_places.hpp"
#include "world_import/moving_ai.hpp"
#include "world_import/npy_path.hpp"
#include "world_import/ros_map_world.hpp"
#include "world_import/sdf_world.hpp"

namespace clew::world_import {
namespace {

namespace fs = std::filesystem;
using core::Error;
using core::Result;

constexpr double kPictureCell_m = 0.05;
constexpr double kMovingAiCell_m = 0.5;
constexpr char kFormats[] =
    ".yaml (a map of ROS), .world and .sdf (Gazebo, BARN), .map and .scen (MovingAI), .pgm, .png";

/// A file's name as a world may be called: `ca-cave` for `CA_Cave`.
std::string world_name(const std::string& file_name) {
  std::string name;
  for (const char c : file_name) {
    const auto lower = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const bool is_allowed = (lower >= 'a' && lower <= 'z') || (lower >= '0' && lower <= '9');
    name += is_allowed ? lower : '-';
  }
  return name.empty() ? "imported" : name;
}

/// A world of cells, with places for start and target where nobody gives them.
Result<WorldDraft> draft_of(const CellMap& cells, const ImportOptions& options,
                            const std::string& source) {
  WorldDraft draft = world_of(cells, options.unknown_is_blocked);
  if (options.start && options.target) return draft;
  const auto places = far_places(cells, options.unknown_is_blocked, options.robot_radius_m);
  if (!places) {
    return Error{fmt::format("no cell has room for a robot of {} m", options.robot_radius_m),
                 source};
  }
  const Vec2 way = places->second - places->first;
  draft.start = Pose2{places->first.x(), places->first.y(), core::atan2(way.y(), way.x())};
  draft.target = places->second;
  return draft;
}

Result<WorldDraft> read_moving_ai(const std::string& source, const ImportOptions& options) {
  const double cell_m = options.cell_m.value_or(kMovingAiCell_m);
  const auto cells = read_moving_ai_map(source, cell_m);
  if (!cells.ok()) return cells.error();
  return draft_of(*cells, options, source);
}

/// The map that a scenario names lies beside it, under its last name at least.
Result<WorldDraft> read_moving_ai_scenario(const std::string& source,
                                           const ImportOptions& options) {
  const auto scenario = read_scenario(source, options.scenario);
  if (!scenario.ok()) return scenario.error();
  const fs::path folder = fs::path(source).parent_path();
  std::error_code error;
  fs::path path = folder / scenario->map;
  if (!fs::exists(path, error)) path = folder / fs::path(scenario->map).filename();
  const double cell_m = options.cell_m.value_or(kMovingAiCell_m);
  const auto cells = read_moving_ai_map(path.string(), cell_m);
  if (!cells.ok()) return cells.error();
  const auto place = [&](std::size_t column, std::size_t row) -> Result<Vec2> {
    if (column < cells->columns && row < cells->rows) {
      return cells->place(static_cast<double>(column) + 0.5,
                          static_cast<double>(cells->rows - 1 - row) + 0.5);
    }
    return Error{fmt::format("cell ({}, {}) lies outside {}", column, row, path.string()), source};
  };
  const auto from = place(scenario->start_column, scenario->start_row);
  if (!from.ok()) return from.error();
  const auto to = place(scenario->target_column, scenario->target_row);
  if (!to.ok()) return to.error();
  WorldDraft draft = world_of(*cells, options.unknown_is_blocked);
  const Vec2 way = *to - *from;
  draft.start = Pose2{from->x(), from->y(), core::atan2(way.y(), way.x())};
  draft.target = *to;
  draft.about = fmt::format("Optimal over cells: {:.3f} m. ", scenario->optimal_length * cell_m);
  return draft;
}

/// Nothing closes a Gazebo world: its bounds are ours, and hold the places that a person gives.
void hold(const Vec2& place, WorldDraft& draft) {
  const Vec2 room(1.0, 1.0);
  draft.bounds_min = draft.bounds_min.cwiseMin(place - room);
  draft.bounds_max = draft.bounds_max.cwiseMax(place + room);
}

/// BARN's worlds are told by their name; its path lies beside.
Result<WorldDraft> read_gazebo(const std::string& source, const ImportOptions& options) {
  auto draft = read_sdf_world(source);
  if (!draft.ok()) return draft.error();
  if (options.start) hold(options.start->position(), *draft);
  if (options.target) hold(*options.target, *draft);
  static const std::regex kBarn(R"(world_(\d+))");
  std::smatch number;
  const std::string stem = fs::path(source).stem().string();
  if (!std::regex_match(stem, number, kBarn)) {
    if (options.start && options.target) return draft;
    return Error{"says nothing of a start and a target; give --start and --target", source};
  }
  add_barn_mission(*draft);
  const fs::path path = fs::path(source).parent_path() / ("path_" + number[1].str() + ".npy");
  std::error_code error;
  if (!fs::exists(path, error)) return draft;
  const auto cells = read_npy_points(path.string());
  if (!cells.ok()) return cells.error();
  draft->about = fmt::format("BARN's own path between the obstacles is {:.3f} m long. ",
                             length_m(barn_path_places(*cells)));
  return draft;
}

Result<WorldDraft> read_source(const std::string& source, const ImportOptions& options) {
  const std::string kind = fs::path(source).extension().string();
  if (kind == ".yaml" || kind == ".yml") {
    const auto cells = read_ros_map_cells(source);
    if (!cells.ok()) return cells.error();
    return draft_of(*cells, options, source);
  }
  if (kind == ".pgm" || kind == ".png") {
    const auto cells = read_picture_cells(source, options.cell_m.value_or(kPictureCell_m));
    if (!cells.ok()) return cells.error();
    return draft_of(*cells, options, source);
  }
  if (kind == ".map") return read_moving_ai(source, options);
  if (kind == ".scen") return read_moving_ai_scenario(source, options);
  if (kind == ".world" || kind == ".sdf") return read_gazebo(source, options);
  return Error{"is of no kind that is known here: " + std::string(kFormats), source};
}

}  // namespace

Result<std::string> import_world(const std::string& source, const ImportOptions& options) {
  auto draft = read_source(source, options);
  if (!draft.ok()) return draft.error();
  draft->name = world_name(fs::path(source).stem().string());
  draft->about += "Imported from " + fs::path(source).filename().string() + '.';
  if (options.start) draft->start = *options.start;
  if (options.target) draft->target = *options.target;
  if (options.target_radius_m) draft->target_radius_m = *options.target_radius_m;
  std::string text = world_text(*draft);
  const auto world = world::World::parse(text, source);
  // Places in the text that is not written yet would help nobody.
  if (!world.ok()) return Error{world.error().message, source};
  const auto fits = world->check_robot_fits(options.robot_radius_m);
  if (!fits.ok()) return Error{fits.error().message, source};
  return text;
}

}  // namespace clew::world_import

// SPDX-License-Identifier: Apache-2.0
#include "world_import/moving_ai.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "map/pgm.hpp"
#include "world_import/picture_file.hpp"

namespace clew::world_import {
namespace {

using core::Error;
using core::Result;

/// The next line, without the CR of other systems.
bool next_line(std::istringstream& lines, std::string& line) {
  if (!std::getline(lines, line)) return false;
  if (!line.empty() && line.back() == '\r') line.pop_back();
  return true;
}

Result<std::size_t> read_size(std::istringstream& lines, const char* key, int number,
                              const std::string& path) {
  std::string line;
  std::string found;
  long long value = 0;
  next_line(lines, line);
  std::istringstream words(line);
  if (words >> found >> value && found == key && value >= 1 && value <= 65536) {
    return static_cast<std::size_t>(value);
  }
  return Error{fmt::format("found '{}', expected '{} N', N from 1 to 65536", line, key), path,
               number, 0};
}

Result<void> read_row(const std::string& line, std::size_t row, CellMap& map,
                      const std::string& path) {
  constexpr std::string_view kFree = ".GS";
  constexpr std::string_view kBlocked = "@OTW";
  constexpr int kHeadLines = 4;
  const int number = static_cast<int>(row) + kHeadLines + 1;
  if (line.size() != map.columns) {
    return Error{fmt::format("has {} cells; allowed: {}", line.size(), map.columns), path, number,
                 0};
  }
  for (std::size_t column = 0; column < map.columns; ++column) {
    const char c = line[column];
    if (kFree.find(c) == std::string_view::npos && kBlocked.find(c) == std::string_view::npos) {
      return Error{fmt::format("found '{}'; allowed: . G S @ O T W", c), path, number,
                   static_cast<int>(column) + 1};
    }
    map.cells[(map.rows - 1 - row) * map.columns + column] =
        kFree.find(c) != std::string_view::npos ? CellState::kFree : CellState::kOccupied;
  }
  return {};
}

}  // namespace

Result<CellMap> read_moving_ai_map(const std::string& path, double cell_m) {
  const auto text = read_file(path);
  if (!text.ok()) return text.error();
  std::istringstream lines(*text);
  std::string line;
  next_line(lines, line);
  if (line.compare(0, 5, "type ") != 0) {
    return Error{"found '" + line.substr(0, 40) + "', expected 'type octile'", path, 1, 0};
  }
  const auto rows = read_size(lines, "height", 2, path);
  if (!rows.ok()) return rows.error();
  const auto columns = read_size(lines, "width", 3, path);
  if (!columns.ok()) return columns.error();
  if (*rows * *columns > map::kMaxMapCells) {
    return Error{
        fmt::format("has {} cells; allowed: at most {}", *rows * *columns, map::kMaxMapCells), path,
        3, 0};
  }
  if (!next_line(lines, line) || line != "map") {
    return Error{"found '" + line.substr(0, 40) + "', expected 'map'", path, 4, 0};
  }
  CellMap map;
  map.rows = *rows;
  map.columns = *columns;
  map.cell_m = cell_m;
  map.cells.resize(map.rows * map.columns);
  for (std::size_t row = 0; row < map.rows; ++row) {
    if (!next_line(lines, line)) {
      return Error{fmt::format("ends after row {} of {}", row, map.rows), path};
    }
    CLEW_RETURN_IF_ERROR(read_row(line, row, map, path));
  }
  return map;
}

Result<Scenario> read_scenario(const std::string& path, std::optional<std::size_t> number) {
  const auto text = read_file(path);
  if (!text.ok()) return text.error();
  std::istringstream lines(*text);
  std::string line;
  next_line(lines, line);
  if (line.compare(0, 7, "version") != 0) {
    return Error{"found '" + line.substr(0, 40) + "', expected 'version 1'", path, 1, 0};
  }
  std::size_t count = 0;
  std::optional<Scenario> found;
  for (int at = 2; next_line(lines, line); ++at) {
    if (line.empty()) continue;
    Scenario scenario;
    std::istringstream words(line);
    std::size_t bucket = 0;
    std::size_t width = 0;
    std::size_t height = 0;
    if (!(words >> bucket >> scenario.map >> width >> height >> scenario.start_column >>
          scenario.start_row >> scenario.target_column >> scenario.target_row >>
          scenario.optimal_length)) {
      return Error{"is no scenario: bucket map width height x y x y length", path, at, 0};
    }
    ++count;
    if (!number || *number == count) found = scenario;
  }
  if (found) return *found;
  return Error{fmt::format("has {} scenarios; no {} is asked for", count, number.value_or(1)),
               path};
}

}  // namespace clew::world_import

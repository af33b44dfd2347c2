// SPDX-License-Identifier: Apache-2.0
#include "encounters/encounters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/angle.hpp"
#include "core/geometry.hpp"
#include "trap_worlds/dice.hpp"

namespace clew::encounters {
namespace {

using core::Vec2;
using trap_worlds::Dice;

constexpr double kTargetRadius_m = 0.3;
constexpr std::uint64_t kMaxTicks = 6000;
// Between robots of a ring or a room, where they begin.
constexpr double kSpacing_m = 1.1;
constexpr int kRows = 5;

/// To millimetres, which files and fleets have alike.
double rounded(double value_m) { return std::round(value_m * 1000.0) / 1000.0; }

std::string head(const std::string& name, double width_m, double height_m) {
  return fmt::format("format: clew-world/1\nname: {}\nbounds: [0, 0, {:.3f}, {:.3f}]\n", name,
                     width_m, height_m);
}

void add_robot(Encounter& encounter, const Vec2& start, double heading_rad, const Vec2& target,
               const std::string& graph) {
  fleet::RobotEntry robot;
  robot.name = fmt::format("r{}", encounter.fleet.robots.size());
  robot.graph = graph;
  robot.start = {rounded(start.x()), rounded(start.y()), rounded(heading_rad)};
  robot.target = {rounded(target.x()), rounded(target.y())};
  robot.target_radius_m = kTargetRadius_m;
  robot.place = {encounter.name, 0, 0};
  robot.start_place = robot.place;
  robot.target_place = robot.place;
  encounter.fleet.robots.push_back(std::move(robot));
}

/// The end of a world file: what one robot would do there, which a fleet does not look at.
std::string tail(const Encounter& encounter) {
  const fleet::RobotEntry& robot = encounter.fleet.robots.front();
  return fmt::format("start: [{}, {}, {}]\ntarget: [{}, {}]\ntarget_radius: {}\n", robot.start.x_m,
                     robot.start.y_m, robot.start.heading_rad, robot.target.x(), robot.target.y(),
                     kTargetRadius_m);
}

void make_crossing(Encounter& encounter, int robots, Dice& dice, const std::string& graph) {
  const double ring_m =
      std::max(2.0, kSpacing_m * static_cast<double>(robots) / (2.0 * core::kPi)) +
      dice.between(0.0, 0.5);
  const double side_m = 2.0 * ring_m + 2.0;
  const Vec2 middle(side_m / 2.0, side_m / 2.0);
  const double turn_rad = dice.between(0.0, 2.0 * core::kPi);
  for (int i = 0; i < robots; ++i) {
    const double angle_rad = turn_rad + 2.0 * core::kPi * i / robots + dice.between(-0.03, 0.03);
    const Vec2 out = core::direction(angle_rad);
    add_robot(encounter, middle + ring_m * out, core::wrap_angle_rad(angle_rad + core::kPi),
              middle - ring_m * out, graph);
  }
  encounter.world = head(encounter.name, side_m, side_m) + tail(encounter);
}

/// Two rooms with a wall between them that is `thick_m` thick and has one opening.
void make_rooms(Encounter& encounter, int robots, Dice& dice, const std::string& graph,
                double thick_m, double open_m) {
  const int columns = (robots / 2 + robots % 2 + kRows - 1) / kRows;
  const double room_m = 2.0 + kSpacing_m * 2.0 * columns;
  const double height_m = kSpacing_m * (kRows + 1);
  const double width_m = 2.0 * room_m + thick_m;
  const double low_m = height_m / 2.0 + dice.between(-0.8, 0.8) - open_m / 2.0;
  // From the far wall of each room: a column of targets, one of starts, and so on.
  const auto place = [&](bool west, int number, bool start) {
    const int column = 2 * (number / kRows) + (start ? 1 : 0);
    const double x_m = 0.6 + kSpacing_m * column + dice.between(-0.1, 0.1);
    const double y_m = kSpacing_m * (number % kRows + 1) + dice.between(-0.1, 0.1);
    return Vec2(west ? x_m : width_m - x_m, y_m);
  };
  for (int i = 0; i < robots; ++i) {
    const bool west = i % 2 == 0;
    const Vec2 start = place(west, i / 2, true);
    const Vec2 target = place(!west, i / 2, false);
    add_robot(encounter, start, west ? 0.0 : core::kPi, target, graph);
  }
  const auto block = [&](double from_m, double to_m) {
    return fmt::format(
        "[[{0:.3f}, {2:.3f}], [{1:.3f}, {2:.3f}], [{1:.3f}, {3:.3f}], [{0:.3f}, {3:.3f}]]", room_m,
        room_m + thick_m, from_m, to_m);
  };
  encounter.world = head(encounter.name, width_m, height_m) + "polygons: [" + block(0.0, low_m) +
                    ", " + block(low_m + open_m, height_m) + "]\n" + tail(encounter);
}

}  // namespace

const std::vector<std::string>& family_names() {
  static const std::vector<std::string> names = {"crossing", "corridor", "door"};
  return names;
}

Encounter make_encounter(Family family, int robots, std::uint32_t number, std::uint64_t seed,
                         const std::string& graph) {
  Encounter encounter;
  const std::string& word = family_names()[static_cast<std::size_t>(family)];
  encounter.name = fmt::format("{}-{:02}-{}", word, robots, number);
  encounter.family = family;
  encounter.fleet.name = encounter.name;
  encounter.fleet.world = encounter.name;
  encounter.fleet.max_ticks = kMaxTicks;
  encounter.fleet.seed = seed;
  encounter.fleet.about = fmt::format("{} robots, {} {}, seed {}.", robots, word, number, seed);
  Dice dice({seed, static_cast<std::uint32_t>(family), static_cast<std::uint32_t>(robots), number});
  switch (family) {
    case Family::kCrossing:
      make_crossing(encounter, robots, dice, graph);
      break;
    case Family::kCorridor:
      make_rooms(encounter, robots, dice, graph, 3.0, dice.between(0.5, 1.2));
      break;
    case Family::kDoor:
      make_rooms(encounter, robots, dice, graph, 0.2, dice.between(0.5, 0.8));
      break;
  }
  return encounter;
}

}  // namespace clew::encounters

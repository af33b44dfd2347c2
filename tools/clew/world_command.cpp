// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "clew/command_line.hpp"
#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "clew/json_line.hpp"
#include "files/whole_file.hpp"
#include "plot/plot.hpp"
#include "runtime/run_plan.hpp"
#include "stages/all.hpp"
#include "world_analysis/backtrack.hpp"
#include "world_analysis/reachability.hpp"
#include "world_analysis/shortest_path.hpp"
#include "world_analysis/trap_map.hpp"

namespace clew::tools {
namespace {

using core::Error;
using core::Result;
using nlohmann::ordered_json;

/// A way counts only with this much room beside the robot: a gap that fits in theory is none.
constexpr double kMargin_m = 0.02;
/// A length that a world states may differ by so much from the one that is computed.
constexpr double kTolerance = 0.02;
/// With more places than that the answer takes more than a few seconds.
constexpr double kManyPlaces = 5e6;

struct WorldOptions {
  std::string world;
  std::string robot = "disc-015";
  std::string output;
  std::string graph = "default";
  double range_m = 0.0;  ///< of the sensor; 0: that of the graph's
  bool json = false;
};

struct Subject {
  core::Resource file;
  world::World world;
  double radius_m = 0.0;
};

Result<Subject> read_subject(const WorldOptions& options) {
  const auto configs = runtime::ConfigPath::from_environment();
  auto file = configs.find("worlds", options.world);
  if (!file.ok()) return file.error();
  auto world = world::World::parse(file->text, file->file);
  if (!world.ok()) return world.error();
  const auto robot_file = configs.find("robots", options.robot);
  if (!robot_file.ok()) return robot_file.error();
  const auto robot = runtime::read_robot(*robot_file, options.robot);
  if (!robot.ok()) return robot.error();
  CLEW_RETURN_IF_ERROR(world->check_robot_fits(robot->radius_m));
  return Subject{std::move(file).value(), std::move(world).value(), robot->radius_m};
}

/// What is true of a world and a robot, obstacles standing where they come to rest.
struct Findings {
  bool surveyed = false;         ///< else nothing is known, and `undecided` says why
  std::optional<bool> solvable;  ///< none: not surveyed, or only gaps just as wide as the robot
  std::optional<double> shortest_path_m;
  /// No shallower than the robot is wide, and within the robot's reach.
  std::vector<world_analysis::Trap> traps;
  std::optional<double> backtrack_m;  ///< what no way avoids; if asked for
  std::string undecided;              ///< why; empty if it is decided
};

enum class Backtrack { kLeaveOut, kFind };

/// Leaves the traps out that the robot cannot get into, such as those of a room that is closed.
std::vector<world_analysis::Trap> within_reach(const std::vector<world_analysis::Trap>& traps) {
  std::vector<std::optional<std::size_t>> kept(traps.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < traps.size(); ++i) {
    if (traps[i].from_start) kept[i] = count++;
  }
  std::vector<world_analysis::Trap> reached;
  for (const world_analysis::Trap& trap : traps) {
    if (!trap.from_start) continue;
    reached.push_back(trap);
    // One inside of another is of the same room.
    if (trap.inside_of) reached.back().inside_of = kept[*trap.inside_of];
  }
  return reached;
}

void tell_long_wait(const world::World& world) {
  const double places = world_analysis::lattice_nodes(world);
  if (places < kManyPlaces) return;
  fmt::print(stderr, "clew: {} has {:.0f} million places to look at, a few seconds a million\n",
             world.name(), 1e-6 * places);
}

Findings find_out(const Subject& subject, Backtrack backtrack = Backtrack::kLeaveOut) {
  Findings findings;
  const auto time_s = world_analysis::surveyed_time_s(subject.world);
  if (!time_s.ok()) {
    findings.undecided = time_s.error().message;
    return findings;
  }
  findings.surveyed = true;
  tell_long_wait(subject.world);
  const world_analysis::ClearanceGrid grid(subject.world, *time_s);
  const auto solvable = world_analysis::is_solvable(grid, subject.radius_m, kMargin_m);
  if (solvable == world_analysis::Solvable::kUndecided) {
    findings.undecided = "the only ways lead through gaps about as wide as the robot";
  } else {
    findings.solvable = solvable == world_analysis::Solvable::kYes;
  }
  if (findings.solvable == true) {
    const auto path = world_analysis::shortest_path(grid, subject.radius_m);
    if (path) findings.shortest_path_m = path->length_m;
  }
  const world_analysis::TrapMap map(grid, subject.radius_m, 2.0 * subject.radius_m);
  findings.traps = within_reach(map.traps());
  if (backtrack == Backtrack::kFind) {
    findings.backtrack_m = world_analysis::necessary_backtrack_m(grid, subject.radius_m);
  }
  return findings;
}

ordered_json to_json(const Subject& subject, const Findings& findings) {
  ordered_json json = {{"world", subject.world.name()}, {"robot_radius_m", subject.radius_m}};
  json["solvable"] = findings.solvable ? ordered_json(*findings.solvable) : ordered_json(nullptr);
  json["shortest_path_m"] =
      findings.shortest_path_m ? ordered_json(*findings.shortest_path_m) : ordered_json(nullptr);
  json["traps"] = ordered_json::array();
  for (const world_analysis::Trap& trap : findings.traps) {
    // Without a way out a trap has no depth.
    json["traps"].push_back(
        {{"x_m", trap.place.x()},
         {"y_m", trap.place.y()},
         {"depth_m", std::isfinite(trap.depth_m) ? ordered_json(trap.depth_m) : nullptr}});
  }
  json["undecided"] = findings.undecided;
  return json;
}

void print(const Subject& subject, const Findings& findings) {
  const world::World& world = subject.world;
  fmt::print("{}: {} m x {} m, robot of {} m\n", world.name(),
             world.bounds_max().x() - world.bounds_min().x(),
             world.bounds_max().y() - world.bounds_min().y(), subject.radius_m);
  if (findings.solvable) {
    fmt::print("solvable: {}\n", *findings.solvable);
  } else {
    fmt::print("solvable: unknown, {}\n", findings.undecided);
  }
  if (findings.shortest_path_m) fmt::print("shortest path: {:.3f} m\n", *findings.shortest_path_m);
  for (const world_analysis::Trap& trap : findings.traps) {
    fmt::print("trap at ({:.2f}, {:.2f}), {}\n", trap.place.x(), trap.place.y(),
               std::isfinite(trap.depth_m) ? fmt::format("{:.2f} m deep", trap.depth_m)
                                           : std::string("without a way out"));
  }
  if (findings.traps.empty() && findings.surveyed) {
    fmt::print("no traps\n");
  }
}

/// Where the file states something else than what is true; empty if nowhere.
std::vector<std::string> contradictions(const Subject& subject, const Findings& findings) {
  std::vector<std::string> found;
  const auto stated = subject.world.solvable();
  if (stated && findings.solvable && *stated != *findings.solvable) {
    found.push_back(fmt::format("it says solvable: {}, and it is {}", *stated, *findings.solvable));
  }
  const auto length_m = subject.world.shortest_path_m();
  if (length_m && findings.shortest_path_m &&
      std::fabs(*length_m - *findings.shortest_path_m) > kTolerance * *findings.shortest_path_m) {
    found.push_back(fmt::format("it says shortest_path: {}, and it is {:.3f} m", *length_m,
                                *findings.shortest_path_m));
  }
  return found;
}

/// The file with `key: value` in place of what it says of the key, or at its end.
std::string with_value(const std::string& text, const std::string& key, const std::string& value) {
  std::istringstream lines(text);
  std::string out;
  bool found = false;
  for (std::string line; std::getline(lines, line);) {
    const bool is_key = line.compare(0, key.size() + 1, key + ':') == 0;
    found = found || is_key;
    out += (is_key ? key + ": " + value : line) + '\n';
  }
  return found ? out : out + key + ": " + value + '\n';
}

Result<void> write_solved(const Subject& subject, const Findings& findings,
                          const std::string& output) {
  if (!findings.solvable) return Error{"is not decided: " + findings.undecided, subject.file.file};
  std::string text =
      with_value(subject.file.text, "solvable", *findings.solvable ? "true" : "false");
  if (findings.shortest_path_m) {
    text = with_value(text, "shortest_path", fmt::format("{:.3f}", *findings.shortest_path_m));
  }
  // A file in a style that cannot be added to line by line, as {...}, is refused here.
  const auto again = world::World::parse(text, output);
  if (!again.ok()) return again.error();
  return files::write_file(output, text);
}

int solve_command(const WorldOptions& options) {
  const auto subject = read_subject(options);
  if (!subject.ok()) return complain(subject.error());
  const Findings findings = find_out(*subject);
  if (!options.output.empty()) {
    const auto written = write_solved(*subject, findings, options.output);
    if (!written.ok()) return complain(written.error());
  }
  if (options.json) {
    fmt::print("{}\n", json_line(to_json(*subject, findings)));
  } else {
    print(*subject, findings);
  }
  return kExitGood;
}

int check_command_of_world(const WorldOptions& options) {
  const auto subject = read_subject(options);
  if (!subject.ok()) return complain(subject.error());
  const Findings findings = find_out(*subject);
  const auto wrong = contradictions(*subject, findings);
  if (options.json) {
    ordered_json json = to_json(*subject, findings);
    json["contradictions"] = wrong;
    fmt::print("{}\n", json_line(json));
  } else {
    print(*subject, findings);
  }
  for (const std::string& what : wrong) complain({what, subject->file.file, 0, 0});
  if (wrong.empty() && !options.json) fmt::print("good\n");
  return wrong.empty() ? kExitGood : kExitFailed;
}

/// The range of a graph's sensor.
Result<double> sensing_range_m(const WorldOptions& options) {
  if (options.range_m > 0.0) return options.range_m;
  runtime::GraphOverrides overrides;
  overrides.world = options.world;
  const auto plan = runtime::prepare_run(options.graph, overrides,
                                         runtime::ConfigPath::from_environment(), stages::all());
  if (!plan.ok()) return plan.error();
  return plan->setup.behaviour.scan.range_max_m;
}

/// How many traps lie one in the other, at most: 1 without nested ones, 0 without traps.
std::size_t deepest_nesting(const std::vector<world_analysis::Trap>& traps) {
  std::size_t most = 0;
  for (const world_analysis::Trap& trap : traps) {
    std::size_t levels = 1;
    for (auto outer = trap.inside_of; outer; outer = traps[*outer].inside_of) ++levels;
    most = std::max(most, levels);
  }
  return most;
}

void print_severity(const Subject& subject, const Findings& findings, double range_m) {
  fmt::print("{}: robot of {} m, sensor of {} m\n", subject.world.name(), subject.radius_m,
             range_m);
  for (const world_analysis::Trap& trap : findings.traps) {
    const std::string depth = std::isfinite(trap.depth_m)
                                  ? fmt::format("{:.2f} m deep, {:.2f} sensing ranges",
                                                trap.depth_m, trap.depth_m / range_m)
                                  : std::string("without a way out");
    fmt::print("trap at ({:.2f}, {:.2f}), {}{}\n", trap.place.x(), trap.place.y(), depth,
               trap.inside_of ? fmt::format(", inside trap {}", *trap.inside_of + 1) : "");
  }
  if (findings.traps.empty()) {
    fmt::print("{}\n", findings.surveyed ? "no traps" : findings.undecided);
  }
  if (findings.backtrack_m) {
    fmt::print("necessary backtrack: {:.2f} m, {:.2f} sensing ranges\n", *findings.backtrack_m,
               *findings.backtrack_m / range_m);
  }
}

ordered_json severity_json(const Subject& subject, const Findings& findings, double range_m) {
  const auto in_ranges = [range_m](double length_m) {
    return std::isfinite(length_m) ? ordered_json(length_m / range_m) : ordered_json(nullptr);
  };
  ordered_json json = to_json(subject, findings);
  json["range_m"] = range_m;
  json["resolution_m"] = world_analysis::kSpacing_m;
  double deepest_m = 0.0;
  for (std::size_t i = 0; i < findings.traps.size(); ++i) {
    const world_analysis::Trap& trap = findings.traps[i];
    ordered_json& line = json["traps"][i];
    line["depth_ranges"] = in_ranges(trap.depth_m);
    line["inside_of"] = trap.inside_of ? ordered_json(*trap.inside_of) : ordered_json(nullptr);
    line["area_m2"] =
        static_cast<double>(trap.nodes) * world_analysis::kSpacing_m * world_analysis::kSpacing_m;
    deepest_m = std::max(deepest_m, trap.depth_m);  // a trap without a way out is the worst
  }
  json["severity_ranges"] = in_ranges(deepest_m);
  json["nested_pockets"] = deepest_nesting(findings.traps);
  const auto& backtrack_m = findings.backtrack_m;
  json["necessary_backtrack_m"] = backtrack_m ? ordered_json(*backtrack_m) : ordered_json(nullptr);
  json["necessary_backtrack_ranges"] =
      backtrack_m ? in_ranges(*backtrack_m) : ordered_json(nullptr);
  return json;
}

/// How deep the traps are for a sensor: one that is deeper than the sensor sees cannot be seen
/// through from its bottom.
int severity_command(const WorldOptions& options) {
  const auto subject = read_subject(options);
  if (!subject.ok()) return complain(subject.error());
  const auto range_m = sensing_range_m(options);
  if (!range_m.ok()) return complain(range_m.error());
  const Findings findings = find_out(*subject, Backtrack::kFind);
  if (options.json) {
    fmt::print("{}\n", json_line(severity_json(*subject, findings, *range_m)));
  } else {
    print_severity(*subject, findings, *range_m);
  }
  return kExitGood;
}

int picture_command(const WorldOptions& options) {
  const auto subject = read_subject(options);
  if (!subject.ok()) return complain(subject.error());
  std::vector<core::Vec2> traps;
  for (const world_analysis::Trap& trap : find_out(*subject).traps) traps.push_back(trap.place);
  const auto drawn = plot::plot_world(subject->world, subject->radius_m, traps, options.output);
  return drawn.ok() ? kExitGood : complain(drawn.error());
}

CLI::App* add_part(CLI::App& world, const char* name, const char* about, WorldOptions& options) {
  CLI::App* app = world.add_subcommand(name, about);
  app->add_option("world", options.world, "a name or a path")->required();
  app->add_option("--robot", options.robot, "a name or a path")->capture_default_str();
  return app;
}

}  // namespace

void add_world(CLI::App& main, int& status) {
  CLI::App* world = main.add_subcommand("world", "Import, check, solve and draw a world");
  world->require_subcommand(1);
  const auto options = std::make_shared<WorldOptions>();

  CLI::App* check = add_part(*world, "check", "Whether a world is what it says", *options);
  check->add_flag("--json", options->json, "print it as one JSON object");
  check->callback([options, &status] { status = check_command_of_world(*options); });

  CLI::App* solve =
      add_part(*world, "solve", "Whether it can be solved, its shortest path, its traps", *options);
  solve
      ->add_option("-o,--output", options->output,
                   "write the world with 'solvable' and 'shortest_path' filled in")
      ->check(given_name());
  solve->add_flag("--json", options->json, "print it as one JSON object");
  solve->callback([options, &status] { status = solve_command(*options); });

  CLI::App* severity = add_part(
      *world, "severity", "How deep its traps are, in metres and in sensing ranges", *options);
  severity->add_option("--graph", options->graph, "whose sensor")->capture_default_str();
  severity->add_option("--range", options->range_m, "of the sensor in m, instead of a graph's")
      ->check(number_between(1e-3, 1e6));
  severity->add_flag("--json", options->json, "print it as one JSON object");
  severity->callback([options, &status] { status = severity_command(*options); });

  add_world_import(*world, status);

  CLI::App* picture = add_part(*world, "picture", "Draw it with its traps", *options);
  picture->add_option("-o,--output", options->output, "FILE.svg, FILE.png or FILE.pdf")
      ->required()
      ->check(given_name());
  picture->callback([options, &status] { status = picture_command(*options); });
}

}  // namespace clew::tools

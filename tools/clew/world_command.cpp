// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "clew/command_line.hpp"
#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "clew/json_line.hpp"
#include "clew/print_text.hpp"
#include "clew/world_findings.hpp"
#include "clew/world_severity_command.hpp"
#include "files/whole_file.hpp"
#include "plot/plot.hpp"

namespace clew::tools {
namespace {

using core::Error;
using core::Result;
using nlohmann::ordered_json;

/// A length that a world states may differ by so much from the one that is computed.
constexpr double kTolerance = 0.02;

struct WorldOptions {
  std::string world;
  std::string robot = "disc-015";
  std::string output;
  bool json = false;
};

void print(const WorldSubject& subject, const WorldFindings& findings) {
  const world::World& world = subject.world;
  print_text("{}: {} m x {} m, robot of {} m\n", world.name(),
             world.bounds_max().x() - world.bounds_min().x(),
             world.bounds_max().y() - world.bounds_min().y(), subject.radius_m);
  if (findings.solvable) {
    const auto settled_s = world_analysis::settled_time_s(world);
    const bool moves = settled_s && *settled_s > 0.0;
    print_text("solvable: {}{}\n", *findings.solvable,
               moves ? fmt::format(", once all has come to rest, after {:.1f} s", *settled_s) : "");
  } else {
    print_text("solvable: unknown, {}\n", findings.undecided);
  }
  if (findings.shortest_path_m) {
    print_text("shortest path: {:.3f} m\n", *findings.shortest_path_m);
  } else if (findings.solvable == true) {
    print_text("shortest path: unknown, none ends on the target itself, only within its radius\n");
  }
  for (const world_analysis::Trap& trap : findings.traps) {
    print_text("trap at ({:.2f}, {:.2f}), {}\n", trap.place.x(), trap.place.y(),
               std::isfinite(trap.depth_m) ? fmt::format("{:.2f} m deep", trap.depth_m)
                                           : std::string("without a way out"));
  }
  if (findings.traps.empty() && findings.surveyed) print_text("no traps\n");
}

/// Where the file states something else than what is true; empty if nowhere.
std::vector<std::string> contradictions(const WorldSubject& subject,
                                        const WorldFindings& findings) {
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

Result<void> write_solved(const WorldSubject& subject, const WorldFindings& findings,
                          const std::string& output) {
  if (!findings.solvable) return Error{"is not decided: " + findings.undecided, subject.file.file};
  std::string text =
      with_value(subject.file.text, "solvable", *findings.solvable ? "true" : "false");
  // A file with way-points states no length.
  if (findings.shortest_path_m && subject.world.waypoints().size() <= 1) {
    text = with_value(text, "shortest_path", fmt::format("{:.3f}", *findings.shortest_path_m));
  }
  // A file in a style that cannot be added to line by line, as {...}, is refused here.
  const auto again = world::World::parse(text, output);
  if (!again.ok()) return again.error();
  return files::write_file(output, text);
}

int solve_command(const WorldOptions& options) {
  const auto subject = read_subject(options.world, options.robot);
  if (!subject.ok()) return complain(subject.error());
  const WorldFindings findings = find_out(*subject);
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
  const auto subject = read_subject(options.world, options.robot);
  if (!subject.ok()) return complain(subject.error());
  const WorldFindings findings = find_out(*subject);
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

int picture_command(const WorldOptions& options) {
  const auto subject = read_subject(options.world, options.robot);
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

  add_world_severity(*world, status);
  add_world_import(*world, status);

  CLI::App* picture = add_part(*world, "picture", "Draw it with its traps", *options);
  picture->add_option("-o,--output", options->output, "FILE.svg, FILE.png or FILE.pdf")
      ->required()
      ->check(given_name());
  picture->callback([options, &status] { status = picture_command(*options); });
}

}  // namespace clew::tools

// SPDX-License-Identifier: Apache-2.0
#include "clew/world_severity_command.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/report.hpp"
#include "bench/summary.hpp"
#include "bench/world_names.hpp"
#include "clew/command_line.hpp"
#include "clew/exit_status.hpp"
#include "clew/json_line.hpp"
#include "clew/print_text.hpp"
#include "clew/world_findings.hpp"
#include "runtime/run_plan.hpp"
#include "stages/all.hpp"

namespace clew::tools {
namespace {

using core::Result;
using nlohmann::ordered_json;
using world_analysis::Severity;

struct SeverityOptions {
  std::vector<std::string> worlds;  ///< with wildcards
  std::string robot = "disc-015";
  std::string graph = "default";
  double range_m = 0.0;  ///< of the sensor; 0: that of the graph's
  bool json = false;
};

/// A world, and what is true of it.
struct Judged {
  WorldSubject subject;
  WorldFindings findings;
  double range_m = 0.0;
};

/// The range of a graph's sensor.
Result<double> sensing_range_m(const SeverityOptions& options, const std::string& world) {
  if (options.range_m > 0.0) return options.range_m;
  runtime::GraphOverrides overrides;
  overrides.world = world;
  const auto plan = runtime::prepare_run(options.graph, overrides,
                                         runtime::ConfigPath::from_environment(), stages::all());
  if (!plan.ok()) return plan.error();
  return plan->setup.behaviour.scan.range_max_m;
}

Result<Judged> judge(const SeverityOptions& options, const std::string& world) {
  auto subject = read_subject(world, options.robot);
  if (!subject.ok()) return subject.error();
  const auto range_m = sensing_range_m(options, world);
  if (!range_m.ok()) return range_m.error();
  WorldFindings findings = find_out(*subject, WithSeverity::kYes);
  return Judged{std::move(subject).value(), std::move(findings), *range_m};
}

void print(const Judged& judged) {
  const WorldFindings& findings = judged.findings;
  print_text("{}: robot of {} m, sensor of {} m\n", judged.subject.world.name(),
             judged.subject.radius_m, judged.range_m);
  for (const world_analysis::Trap& trap : findings.traps) {
    const std::string depth = std::isfinite(trap.depth_m)
                                  ? fmt::format("{:.2f} m deep, {:.2f} sensing ranges",
                                                trap.depth_m, trap.depth_m / judged.range_m)
                                  : std::string("without a way out");
    print_text("trap at ({:.2f}, {:.2f}), {}{}\n", trap.place.x(), trap.place.y(), depth,
               trap.inside_of ? fmt::format(", inside trap {}", *trap.inside_of + 1) : "");
  }
  if (!findings.severity) {
    print_text("{}\n", findings.undecided);
    return;
  }
  const Severity& severity = *findings.severity;
  if (findings.traps.empty()) print_text("no traps\n");
  if (severity.backtrack_m) {
    print_text("necessary backtrack: {:.2f} m, {:.2f} sensing ranges\n", *severity.backtrack_m,
               *severity.backtrack_m / judged.range_m);
  }
  print_text("at most, by Bug1: {:.2f} m; by Bug2: {:.2f} m; straight: {:.2f} m\n",
             severity.bug.bug1_m, severity.bug.bug2_m, severity.bug.straight_m);
}

ordered_json to_json(const Judged& judged) {
  // Without a way out a trap has no depth.
  const auto in_ranges = [&](double length_m) {
    return std::isfinite(length_m) ? ordered_json(length_m / judged.range_m) : nullptr;
  };
  const WorldFindings& findings = judged.findings;
  ordered_json json = to_json(judged.subject, findings);
  json["range_m"] = judged.range_m;
  json["resolution_m"] = world_analysis::kSpacing_m;
  for (std::size_t i = 0; i < findings.traps.size(); ++i) {
    const world_analysis::Trap& trap = findings.traps[i];
    ordered_json& line = json["traps"][i];
    line["depth_ranges"] = in_ranges(trap.depth_m);
    line["inside_of"] = trap.inside_of ? ordered_json(*trap.inside_of) : ordered_json(nullptr);
    line["area_m2"] =
        static_cast<double>(trap.nodes) * world_analysis::kSpacing_m * world_analysis::kSpacing_m;
  }
  for (const char* key :
       {"severity_ranges", "nested_pockets", "necessary_backtrack_m", "necessary_backtrack_ranges",
        "straight_m", "bug1_bound_m", "bug2_bound_m"}) {
    json[key] = nullptr;
  }
  if (!findings.severity) return json;
  const Severity& severity = *findings.severity;
  json["severity_ranges"] = in_ranges(severity.deepest_m);
  json["nested_pockets"] = severity.nested_pockets;
  if (severity.backtrack_m) {
    json["necessary_backtrack_m"] = *severity.backtrack_m;
    json["necessary_backtrack_ranges"] = in_ranges(*severity.backtrack_m);
  }
  json["straight_m"] = severity.bug.straight_m;
  json["bug1_bound_m"] = severity.bug.bug1_m;
  json["bug2_bound_m"] = severity.bug.bug2_m;
  return json;
}

std::vector<std::string> row_of(const Judged& judged) {
  const WorldFindings& findings = judged.findings;
  const std::string& name = judged.subject.world.name();
  if (!findings.severity) return {name, findings.undecided, "", "", "", "", "", ""};
  const Severity& severity = *findings.severity;
  const auto text = [](const std::optional<double>& value) {
    return value ? fmt::format("{:.2f}", *value) : std::string("no way");
  };
  const std::string depth = std::isfinite(severity.deepest_m)
                                ? fmt::format("{:.2f}", severity.deepest_m / judged.range_m)
                                : std::string("no way out");
  return {name,
          depth,
          std::to_string(severity.nested_pockets),
          text(severity.backtrack_m),
          text(severity.bug.straight_m),
          text(findings.shortest_path_m),
          text(severity.bug.bug1_m),
          text(severity.bug.bug2_m)};
}

/// Many worlds, a row each.
std::string to_table(const std::vector<Judged>& worlds) {
  bench::Table table;
  table.title = "Severity";
  table.columns = {"world",      "deepest trap, ranges", "nested pockets", "necessary backtrack m",
                   "straight m", "shortest m",           "Bug1 at most m", "Bug2 at most m"};
  for (const Judged& judged : worlds) table.rows.push_back(row_of(judged));
  return bench::to_markdown(table);
}

/// How deep the traps are for a sensor: one that is deeper than the sensor sees cannot be seen
/// through from its bottom.
int severity_command(const SeverityOptions& options) {
  const auto configs = runtime::ConfigPath::from_environment();
  std::vector<Judged> worlds;
  for (const std::string& pattern : options.worlds) {
    const auto names = bench::world_names(pattern, configs);
    if (!names.ok()) return complain(names.error());
    for (const std::string& name : *names) {
      auto judged = judge(options, name);
      if (!judged.ok()) return complain(judged.error());
      worlds.push_back(std::move(judged).value());
    }
  }
  if (options.json) {
    for (const Judged& judged : worlds) fmt::print("{}\n", json_line(to_json(judged)));
  } else if (worlds.size() == 1) {
    print(worlds.front());
  } else {
    print_text("{}", to_table(worlds));
  }
  return kExitGood;
}

}  // namespace

void add_world_severity(CLI::App& world, int& status) {
  const auto options = std::make_shared<SeverityOptions>();
  CLI::App* app = world.add_subcommand("severity",
                                       "How deep its traps are, how they nest, how far back the "
                                       "best way leads, and how long the Bug "
                                       "algorithms take at most");
  app->add_option("world", options->worlds,
                  "names or paths, with a shell's wildcards; several: a table")
      ->required();
  app->add_option("--robot", options->robot, "a name or a path")->capture_default_str();
  app->add_option("--graph", options->graph, "whose sensor")->capture_default_str();
  app->add_option("--range", options->range_m, "of the sensor in m, instead of a graph's")
      ->check(number_between(1e-3, 1e6));
  app->add_flag("--json", options->json, "print each as one JSON object");
  app->callback([options, &status] { status = severity_command(*options); });
}

}  // namespace clew::tools

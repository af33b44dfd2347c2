// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <map>
#include <string>

#include "clew/command_line.hpp"
#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "clew/graph_text.hpp"
#include "clew/json_line.hpp"
#include "clew/plugin_options.hpp"
#include "clew/print_text.hpp"
#include "clew/stage_text.hpp"
#include "robot/robots.hpp"
#include "runtime/run_plan.hpp"
#include "stages/all.hpp"

namespace clew::tools {
namespace {

struct CheckOptions {
  std::string graph;
  runtime::GraphOverrides overrides;
  std::vector<std::string> plugins;
  bool expand = false;
  bool json = false;
  bool dot = false;
};

using runtime::Graph;
using runtime::GraphStage;

void print_wiring(const Graph& graph) {
  for (const GraphStage& stage : graph.stages) {
    for (runtime::Topic topic : stage.ports.output_order) {
      std::string readers;
      for (const GraphStage* reader : graph.readers_of(topic)) {
        readers += (readers.empty() ? "" : ", ") + reader->info->name;
        if (reader->ports.delayed_inputs[index_of(topic)]) {
          readers += " (next tick)";
        }
      }
      print_text("  {:<9} --{}--> {}\n", stage.info->name, domain::topic_name(topic),
                 readers.empty() ? "nobody" : readers);
    }
  }
}

/// How the graph is spread over processes, where it is not one for each stage.
void print_layout(const Graph& graph) {
  if (graph.layout != "processes") print_text("layout: {}\n", graph.layout);
  if (graph.security) {
    print_text("security: {}\n",
               graph.security->empty() ? "keys for each run alone" : "keys in " + *graph.security);
  }
  std::map<std::string, std::string> stages_of;
  for (const GraphStage& stage : graph.stages) {
    std::string& stages = stages_of[stage.deployment.group];
    stages += (stages.empty() ? "" : ", ") + stage.info->name;
  }
  for (const auto& [group, stages] : stages_of) {
    if (!group.empty()) print_text("group {}: {} in one process\n", group, stages);
  }
}

int check_command(const CheckOptions& options) {
  const auto plugins = load_plugins_of(options.plugins, options.graph);
  if (!plugins.ok()) return complain(plugins.error());
  const auto plan = runtime::prepare_run(options.graph, options.overrides,
                                         runtime::ConfigPath::from_environment(), stages::all());
  if (!plan.ok()) return complain(plan.error());
  const Graph& graph = plan->graph;
  const auto robots = robot::check_robots(graph);
  if (!robots.ok()) return complain(robots.error());
  if (options.expand) {
    print_text("{}", graph.expanded_yaml());
    return kExitGood;
  }
  if (options.json || options.dot) {
    print_text("{}", options.json ? json_line(json_of(*plan)) + '\n' : dot_of(graph));
    return kExitGood;
  }
  print_text("graph {}: world {}, robot {} ({} m), tick {} s\n", graph.name, graph.world,
             graph.robot, plan->setup.behaviour.robot.radius_m, graph.tick_s);
  for (const GraphStage& stage : graph.stages) {
    print_text("  {:<9} {}\n", stage.info->name, stage_text(stage));
  }
  print_layout(graph);
  print_text("wiring:\n");
  print_wiring(graph);
  for (const std::string& port : graph.unwired) print_text("unwired: {} (optional)\n", port);
  print_text("good\n");
  return kExitGood;
}

}  // namespace

void add_check(CLI::App& main, int& status) {
  const auto options = std::make_shared<CheckOptions>();
  CLI::App* app = main.add_subcommand("check", "Check a graph and show its wiring");
  app->add_option("graph", options->graph, "a name or a path")->required();
  add_overrides(*app, options->overrides);
  add_plugins(*app, options->plugins);
  auto* expand =
      app->add_flag("--expand", options->expand, "print the graph with every value in it");
  auto* json = app->add_flag("--json", options->json, "print it as one JSON object");
  auto* dot = app->add_flag("--dot", options->dot, "print a drawing for Graphviz's 'dot -Tsvg'");
  expand->excludes(json)->excludes(dot);
  json->excludes(dot);
  app->callback([options, &status] { status = check_command(*options); });
}

}  // namespace clew::tools

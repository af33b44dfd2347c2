// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "clew/commands.hpp"
#include "clew/stage_text.hpp"
#include "runtime/run_plan.hpp"
#include "stages/all.hpp"

namespace clew::tools {
namespace {

using runtime::Graph;
using runtime::GraphStage;

void print_wiring(const Graph& graph) {
  for (const GraphStage& stage : graph.stages) {
    for (runtime::Topic topic : stage.ports.output_order) {
      std::string readers;
      for (const GraphStage* reader : graph.readers_of(topic)) {
        readers += (readers.empty() ? "" : ", ") + reader->info->name;
        if (reader->ports.delayed_inputs[static_cast<std::size_t>(topic)]) {
          readers += " (next tick)";
        }
      }
      fmt::print("  {:<9} --{}--> {}\n", stage.info->name, domain::topic_name(topic),
                 readers.empty() ? "nobody" : readers);
    }
  }
}

}  // namespace

int check_command(const CheckOptions& options) {
  const auto plan = runtime::prepare_run(options.graph, options.overrides,
                                         runtime::ConfigPath::from_environment(), stages::all());
  if (!plan.ok()) return complain(plan.error());
  const Graph& graph = plan->graph;
  if (options.expand) {
    fmt::print("{}", graph.expanded_yaml());
    return kExitGood;
  }
  fmt::print("graph {}: world {}, robot {} ({} m), tick {} s\n", graph.name, graph.world,
             graph.robot, plan->setup.behaviour.robot.radius_m, graph.tick_s);
  for (const GraphStage& stage : graph.stages) {
    fmt::print("  {:<9} {}\n", stage.info->name, stage_text(stage));
  }
  fmt::print("wiring:\n");
  print_wiring(graph);
  for (const std::string& port : graph.unwired) fmt::print("unwired: {} (optional)\n", port);
  fmt::print("good\n");
  return kExitGood;
}

}  // namespace clew::tools

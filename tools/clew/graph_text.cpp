// SPDX-License-Identifier: Apache-2.0
#include "clew/graph_text.hpp"

#include <fmt/format.h>

#include "clew/stage_text.hpp"

namespace clew::tools {
namespace {

using nlohmann::ordered_json;
using runtime::Graph;
using runtime::GraphStage;

ordered_json stage_json(const GraphStage& stage) {
  ordered_json json = {{"stage", stage.info->name}};
  if (!stage.deployment.exec.empty()) json["exec"] = stage.deployment.exec;
  if (stage.deployment.ros2) json["ros2"] = *stage.deployment.ros2;
  for (const auto& [part, choices] : stage.config.parts) {
    json[part] = ordered_json::array();
    for (const auto& choice : choices) json[part].push_back(choice.name);
  }
  if (!stage.deployment.group.empty()) json["group"] = stage.deployment.group;
  return json;
}

/// Calls `tell` for each topic, its writer, and each of its readers.
template <typename Tell>
void for_each_wire(const Graph& graph, const Tell& tell) {
  for (const GraphStage& stage : graph.stages) {
    for (const runtime::Topic topic : stage.ports.output_order) {
      for (const GraphStage* reader : graph.readers_of(topic)) {
        tell(topic, stage, *reader, reader->ports.delayed_inputs[index_of(topic)]);
      }
    }
  }
}

/// Within double quotes of dot.
std::string quoted(const std::string& text) {
  std::string safe;
  for (const char c : text)
    safe += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return '"' + safe + '"';
}

}  // namespace

ordered_json json_of(const runtime::RunPlan& plan) {
  const Graph& graph = plan.graph;
  ordered_json json = {
      {"graph", graph.name},          {"world", graph.world},
      {"robot", graph.robot},         {"radius_m", plan.setup.behaviour.robot.radius_m},
      {"tick_s", graph.tick_s},       {"seed", graph.seed},
      {"max_ticks", graph.max_ticks}, {"layout", graph.layout}};
  json["stages"] = ordered_json::array();
  for (const GraphStage& stage : graph.stages) json["stages"].push_back(stage_json(stage));
  json["wiring"] = ordered_json::array();
  for_each_wire(graph, [&](runtime::Topic topic, const GraphStage& writer, const GraphStage& reader,
                           bool delayed) {
    json["wiring"].push_back({{"topic", domain::topic_name(topic)},
                              {"from", writer.info->name},
                              {"to", reader.info->name},
                              {"delayed", delayed}});
  });
  json["unwired"] = graph.unwired;
  return json;
}

std::string dot_of(const Graph& graph) {
  std::string text =
      fmt::format("digraph {} {{\n  rankdir=LR;\n  node [shape=box];\n", quoted(graph.name));
  for (const GraphStage& stage : graph.stages) {
    text += fmt::format("  {} [label={}];\n", quoted(stage.info->name),
                        quoted(stage.info->name + ": " + stage_text(stage)));
  }
  for_each_wire(graph, [&](runtime::Topic topic, const GraphStage& writer, const GraphStage& reader,
                           bool delayed) {
    text += fmt::format("  {} -> {} [label={}{}];\n", quoted(writer.info->name),
                        quoted(reader.info->name), quoted(std::string(domain::topic_name(topic))),
                        delayed ? ", style=dashed" : "");
  });
  return text + "}\n";
}

}  // namespace clew::tools

// SPDX-License-Identifier: Apache-2.0
#include "runtime/run_plan.hpp"

#include <optional>
#include <utility>

#include "core/quoted.hpp"
#include "core/yaml_fields.hpp"
#include "core/yaml_reader.hpp"
#include "world/world.hpp"

namespace clew::runtime {
namespace {

using core::Result;

constexpr char kRobotFormat[] = "clew-robot/1";

// What a name in a graph stands for is not there (and the error says what it should be), or cannot
// be read: said where the name stands.
core::Error not_found(const Place& place, const std::string& key, const core::Error& error) {
  return place.error((error.file.empty() ? "" : key + ": ") + error.text());
}

Result<void> load_world(const ConfigSource& source, RunPlan& plan) {
  auto file = source.find("worlds", plan.graph.world);
  if (!file.ok()) return not_found(plan.graph.world_place, "world", file.error());
  auto world = world::World::parse(file->text, file->file, plan.graph.goals);
  if (!world.ok() && world.error().file.empty()) {
    return plan.graph.goals_place.error(world.error().message);
  }
  if (!world.ok()) return world.error();
  const auto fits = world->check_robot_fits(plan.setup.behaviour.robot.radius_m);
  if (!fits.ok()) {
    core::Error error = fits.error();
    if (error.file.empty()) error.file = file->file;
    return error;
  }
  plan.graph.world = world->name();
  plan.setup.world = std::make_shared<const world::World>(std::move(world).value());
  plan.bundle["world.yaml"] = std::move(file->text);
  return {};
}

Result<void> load_robot(const ConfigSource& source, RunPlan& plan) {
  auto file = source.find("robots", plan.graph.robot);
  if (!file.ok()) return not_found(plan.graph.robot_place, "robot", file.error());
  auto robot = read_robot(*file, plan.graph.robot);
  if (!robot.ok()) return robot.error();
  plan.graph.robot = robot->name;
  plan.setup.behaviour.robot = std::move(robot).value();
  plan.bundle["robot.yaml"] = std::move(file->text);
  return {};
}

Result<void> load_data_files(const ConfigSource& source, RunPlan& plan) {
  for (const GraphStage& stage : plan.graph.stages) {
    if (!stage.deployment.is_ours()) continue;
    for (const auto& [parameter, folder, name, place] : stage.files) {
      auto file = source.find(folder, name);
      if (!file.ok()) return not_found(place, parameter, file.error());
      add_to_bundle(folder, name, *file, plan.bundle);
      plan.setup.behaviour.resources.add(folder, name, std::move(file).value());
    }
  }
  return {};
}

void fill_setup(RunPlan& plan) {
  plan.setup.seed = plan.graph.seed;
  plan.setup.max_ticks = plan.graph.max_ticks;
  plan.setup.robot_index = static_cast<std::uint32_t>(plan.graph.robot_index);
  plan.setup.behaviour.robot_index = plan.setup.robot_index;
  plan.setup.behaviour.tick_s = plan.graph.tick_s;
  for (const GraphStage& stage : plan.graph.stages) {
    if (stage.info->scan_layout) {
      plan.setup.behaviour.scan = stage.info->scan_layout(stage.config);
    }
    if (stage.info->motion_limits) {
      plan.setup.behaviour.limits = stage.info->motion_limits(stage.config);
    }
  }
}

// Said where the graph names the file that is wrong, else where the stage stands.
core::Error in_stage(const RunPlan& plan, const GraphStage& stage, const core::Error& error) {
  for (const NamedFile& named : stage.files) {
    const auto file = plan.setup.behaviour.resources.find(named.folder, named.name);
    if (file.ok() && file->file == error.file) {
      return named.place.error(named.parameter + ": " + error.text());
    }
  }
  return stage.place.error(stage.info->name + ": " + error.text());
}

/// Somebody must judge the outcome.
Result<void> check_referee(const Graph& graph, const std::vector<StageInfo>& stages) {
  if (graph.writer_of(Topic::kState) != nullptr) return {};
  return graph.place.error("a graph needs a " + writer_of(Topic::kState, stages) +
                           ": it judges the outcome");
}

Result<void> check_parts_fit(const RunPlan& plan) {
  for (const GraphStage& stage : plan.graph.stages) {
    if (!stage.deployment.is_ours()) continue;
    const auto node = make_node(plan, stage);
    if (!node.ok()) return node.error();
  }
  return {};
}

/// Who has only the bundle knows the graph's name from this.
std::string name_line(const std::string& name) { return "name: " + core::yaml_quoted(name) + '\n'; }

bool knows_world(const Graph& graph, const std::string& stage) {
  const GraphStage* found = graph.find(stage);
  return found != nullptr && found->info->knows_world;
}

// With `only`, as far as that stage needs it.
Result<RunPlan> read_run(const std::string& graph_name, const GraphOverrides& overrides,
                         const ConfigSource& source, const std::vector<StageInfo>& stages,
                         const std::optional<std::string>& only = {}) {
  const auto file = source.find("graphs", graph_name);
  if (!file.ok()) return file.error();
  auto graph = load_graph(*file, graph_name, overrides, stages);
  if (!graph.ok()) return graph.error();
  RunPlan plan;
  plan.known_stages = &stages;
  plan.graph = std::move(graph).value();
  CLEW_RETURN_IF_ERROR(check_referee(plan.graph, stages));
  CLEW_RETURN_IF_ERROR(load_robot(source, plan));
  if (!only || knows_world(plan.graph, *only)) CLEW_RETURN_IF_ERROR(load_world(source, plan));
  CLEW_RETURN_IF_ERROR(load_data_files(source, plan));
  fill_setup(plan);
  plan.bundle["graph.yaml"] = name_line(plan.graph.name) + plan.graph.expanded_yaml();
  return plan;
}

}  // namespace

Result<domain::Robot> read_robot(const core::Resource& file, const std::string& name) {
  const auto root = core::YamlNode::parse(file.text, file.file);
  if (!root.ok()) return root.error();
  CLEW_RETURN_IF_ERROR(core::check_format(*root, kRobotFormat));
  CLEW_RETURN_IF_ERROR(root->check_keys({"format", "name", "about", "radius_m"}));
  domain::Robot robot;
  robot.name = name;
  if (const auto own_name = root->find("name")) {
    auto text = own_name->string();
    if (!text.ok()) return text.error();
    robot.name = std::move(text).value();
  }
  const auto node = root->at("radius_m");
  if (!node.ok()) return node.error();
  const auto radius_m = node->number();
  if (!radius_m.ok()) return radius_m.error();
  if (*radius_m < 0.01 || *radius_m > 5.0) {
    return node->error("radius_m is " + node->found() + "; allowed: 0.01 to 5 m");
  }
  robot.radius_m = *radius_m;
  return robot;
}

Result<RunPlan> prepare_run(const std::string& graph_name, const GraphOverrides& overrides,
                            const ConfigSource& source, const std::vector<StageInfo>& stages) {
  auto plan = read_run(graph_name, overrides, source, stages);
  if (plan.ok()) CLEW_RETURN_IF_ERROR(check_parts_fit(*plan));
  return plan;
}

Result<RunPlan> prepare_run(const Bundle& bundle, const std::vector<StageInfo>& stages) {
  return prepare_run("graph", {}, BundleSource(bundle), stages);
}

Result<RunPlan> read_prepared_run(const Bundle& bundle, const std::vector<StageInfo>& stages,
                                  const std::string& only) {
  return read_run("graph", {}, BundleSource(bundle), stages, only);
}

Result<RunPlan> read_changed_run(const GraphOverrides& overrides, const ConfigSource& source,
                                 const std::vector<StageInfo>& stages,
                                 const std::optional<std::string>& only) {
  return read_run("graph", overrides, source, stages, only);
}

Result<Node> make_node(const RunPlan& plan, const GraphStage& stage) {
  RunSetup setup = plan.setup;
  if (!stage.info->knows_world) setup.world.reset();
  auto component = stage.info->make(stage.config, setup);
  if (!component.ok()) return in_stage(plan, stage, component.error());
  return Node(stage.info->name, stage.ports, std::move(component).value(), plan.graph.tick_s);
}

Result<std::vector<Node>> make_nodes(const RunPlan& plan) {
  std::vector<Node> nodes;
  for (const GraphStage& stage : plan.graph.stages) {
    if (!stage.deployment.is_ours()) {
      return stage.place.error(
          stage.info->name +
          (stage.deployment.ros2 ? " has ros2: a robot" : " has exec: a third-party component") +
          " is a process, and cannot be composed");
    }
    auto node = make_node(plan, stage);
    if (!node.ok()) return node.error();
    nodes.push_back(std::move(node).value());
  }
  return nodes;
}

}  // namespace clew::runtime

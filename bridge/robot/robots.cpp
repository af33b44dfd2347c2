// SPDX-License-Identifier: Apache-2.0
#include "robot/robots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "drive/registry.hpp"
#include "robot/robot_drive.hpp"
#include "robot/robot_sense.hpp"
#include "world/world.hpp"

namespace clew::robot {
namespace {

/// Of the time in which a run must have started; the rest is for the others.
constexpr double kShareOfStart = 0.6;

/// The settings of a stage in a run on `run_domain`, if that is known.
core::Result<Settings> settings_of(const runtime::GraphStage& stage,
                                   std::optional<int> run_domain) {
  const std::string where = "ros2 of " + stage.info->name + ": ";
  auto settings =
      read_settings(*stage.deployment.ros2, ros2::variable_of_process, "clew_" + stage.info->name);
  if (!settings.ok()) return stage.place.error(where + settings.error().message);
  if (run_domain == settings->network.domain) {
    return stage.place.error(
        fmt::format("{}domain {} is the run's own: ROS needs another one; "
                    "give ROS_DOMAIN_ID, or --domain for the run",
                    where, *run_domain));
  }
  return settings;
}

bool is_robot(const runtime::GraphStage& stage) { return stage.deployment.ros2.has_value(); }

bool is_drive(const runtime::GraphStage& stage) { return stage.ports.delayed_inputs.any(); }

/// Each says the last word to the robot if the other dies.
core::Result<void> check_body(const runtime::Graph& graph) {
  for (const runtime::GraphStage& stage : graph.stages) {
    const std::string& name = stage.info->name;
    const bool is_body = is_drive(stage) || stage.info->scan_layout != nullptr;
    if (is_body && !is_robot(stage)) {
      return stage.place.error(name + " has no ros2: a robot takes the place of sense and drive");
    }
    if (is_robot(stage) && !stage.deployment.group.empty()) {
      return stage.deployment.group_place.error(
          name + " has ros2, and shares a process; allowed: one of its own");
    }
  }
  return {};
}

/// Before an obstacle it brakes as its drive says.
core::Result<void> check_brakes(const runtime::GraphStage& stage) {
  const runtime::PartChoice& drive = stage.config.part("behaviour");
  if (drive.parameters.count("max_acceleration_mps2") > 0) return {};
  return stage.place.error(stage.info->name + " has ros2, and " + drive.name +
                           " as if it could stop at once; allowed: unicycle");
}

}  // namespace

bool has_robot(const runtime::Graph& graph) {
  return std::any_of(graph.stages.begin(), graph.stages.end(), is_robot);
}

core::Result<void> check_robots(const runtime::Graph& graph, std::optional<int> run_domain) {
  if (!has_robot(graph)) return {};
  for (const runtime::GraphStage& stage : graph.stages) {
    if (!is_robot(stage)) continue;
    const auto settings = settings_of(stage, run_domain);
    if (!settings.ok()) return settings.error();
    if (is_drive(stage)) CLEW_RETURN_IF_ERROR(check_brakes(stage));
  }
  return check_body(graph);
}

core::Result<std::shared_ptr<RobotLink>> Robots::meet(const runtime::RunPlan& plan,
                                                      const runtime::GraphStage& stage) {
  const std::string& name = stage.info->name;
  const auto found = links_.find(name);
  if (found != links_.end()) return found->second;
  const auto settings = settings_of(stage, run_domain_);
  if (!settings.ok()) return settings.error();
  auto link = RobotLink::create(*settings, run_id_, plan.graph.tick_s);
  if (!link.ok()) return link.error();
  const auto patience = std::chrono::duration_cast<Time::duration>(
      std::chrono::duration<double>(kShareOfStart * plan.graph.start_timeout_s));
  CLEW_RETURN_IF_ERROR((*link)->wait_until_there(Time::clock::now() + patience));
  return links_[name] = std::move(link).value();
}

void Robots::stand_still() {
  for (const auto& [stage, link] : links_) link->stand_still();
}

core::Result<runtime::Node> Robots::make_node(const runtime::RunPlan& plan,
                                              const runtime::GraphStage& stage) {
  auto link = meet(plan, stage);
  if (!link.ok()) return link.error();
  const domain::BehaviourSetup& setup = plan.setup.behaviour;
  std::unique_ptr<runtime::Component> component;
  if (is_drive(stage)) {
    auto model = drive::drive_models().make(stage.config.part("behaviour"), setup);
    if (!model.ok()) return model.error();
    const world::World& world = *plan.setup.world;
    component = std::make_unique<RobotDrive>(
        *link, std::move(model).value(), drive::Mission{world.waypoints(), plan.setup.max_ticks},
        setup.robot.radius_m, RobotDrive::Handlers{on_notice_, on_fatal_});
  } else {
    component = std::make_unique<RobotSense>(*link, setup.scan, setup.robot.radius_m);
  }
  return runtime::Node(stage.info->name, stage.ports, std::move(component), plan.graph.tick_s);
}

}  // namespace clew::robot

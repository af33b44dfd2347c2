// SPDX-License-Identifier: Apache-2.0
#include "fleet/fleet_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace clew::fleet {
namespace {

using core::Result;

// So that the safety layer of a robot at its start does not hold it back from going away.
constexpr double kStartGap_m = 0.01;

/// The files of a fleet, with one world that is made for one robot.
class RobotSource : public runtime::ConfigSource {
 public:
  RobotSource(const runtime::ConfigSource& files, core::Resource world)
      : files_(files), world_(std::move(world)) {}

  Result<core::Resource> find(const std::string& folder, const std::string& name) const override {
    return folder == "worlds" ? Result<core::Resource>(world_) : files_.find(folder, name);
  }

 private:
  const runtime::ConfigSource& files_;
  core::Resource world_;
};

/// What is wrong with a robot's own world can only be its start: all else has been read before.
core::Error of_robot(const FleetFile& fleet, const RobotEntry& entry, const core::Error& error) {
  if (error.file == fleet.world) {
    return entry.start_place.error("robot " + entry.name + ": " + error.message);
  }
  return entry.place.error("robot " + entry.name + ": " + error.text());
}

double speed_mps(const runtime::RunPlan& plan) { return plan.setup.behaviour.limits.speed_mps; }

}  // namespace

Result<FleetPlan> FleetPlan::prepare(FleetFile file, const FleetOverrides& overrides,
                                     const runtime::ConfigSource& source,
                                     const std::vector<runtime::StageInfo>& stages) {
  FleetPlan plan(std::move(file), overrides, source, stages);
  CLEW_RETURN_IF_ERROR(plan.read_world());
  CLEW_RETURN_IF_ERROR(plan.read_robots());
  CLEW_RETURN_IF_ERROR(plan.check_places());
  CLEW_RETURN_IF_ERROR(plan.place_robots());
  return plan;
}

Result<void> FleetPlan::read_world() {
  const auto file = source_.find("worlds", file_.world);
  if (!file.ok()) return file_.world_place.error("world: " + file.error().text());
  auto world = world::World::parse(file->text, file->file);
  if (!world.ok()) return world.error();
  world_ = std::make_shared<const world::World>(std::move(world).value());
  return {};
}

/// Each robot alone in the world: what it is, and how far it gets in a tick.
Result<void> FleetPlan::read_robots() {
  for (std::size_t i = 0; i < file_.robots.size(); ++i) {
    const RobotEntry& entry = file_.robots[i];
    const auto goal =
        world::World::parse(robot_world_text(*world_, world_->start(),
                                             {world_->target(), world_->target_radius_m()}, {}),
                            file_.world, world::Goals{{entry.target, entry.target_radius_m}});
    if (!goal.ok()) {
      return entry.target_place.error("robot " + entry.name +
                                      ": its target: " + goal.error().message);
    }
    auto plan = plan_of(i, entry, {});
    if (!plan.ok()) return of_robot(file_, entry, plan.error());
    RobotPlan robot{entry, std::move(plan).value(), nullptr, 0.0};
    CLEW_RETURN_IF_ERROR(check_robot(robot));
    robot.seen_radius_m =
        robot.plan.setup.behaviour.robot.radius_m + speed_mps(robot.plan) * robot.plan.graph.tick_s;
    robots_.push_back(std::move(robot));
  }
  return check_ticks(kMostPlaces);
}

Result<void> FleetPlan::check_ticks(std::uint64_t most) const {
  std::uint64_t most_ticks = 0;
  std::uint64_t places = 0;
  for (const RobotPlan& robot : robots_) {
    most_ticks = std::max(most_ticks, robot.plan.setup.max_ticks);
    places += std::min(robot.plan.setup.max_ticks, most + 1);
  }
  if (places <= most) return {};
  return file_.robots_place.error(
      fmt::format("{} robots of up to {} ticks; allowed: {} ticks of all robots together "
                  "(max_ticks)",
                  robots_.size(), most_ticks, most));
}

Result<void> FleetPlan::check_robot(const RobotPlan& robot) const {
  const runtime::Graph& graph = robot.plan.graph;
  const auto refuse = [&](const std::string& text) {
    return robot.entry.place.error("robot " + robot.entry.name + ": " + text);
  };
  for (const runtime::GraphStage& stage : graph.stages) {
    if (!stage.deployment.is_ours()) {
      return refuse("its graph " + graph.name + " has a " + stage.info->name +
                    " of someone else's; allowed in a fleet: our own behaviours");
    }
    if (!stage.deployment.host.empty()) {
      return refuse("its " + stage.info->name + " is on host " + stage.deployment.host +
                    "; a fleet's components all run on this host");
    }
  }
  const auto* drive = graph.find("drive");
  const auto safety = drive->config.parameters.find("safety");
  if (safety != drive->config.parameters.end() && std::get<bool>(safety->second) == false) {
    return refuse("drive.safety is false; allowed in a fleet: true, which keeps robots apart");
  }
  if (!std::isfinite(speed_mps(robot.plan))) {
    return refuse("its drive has no greatest speed; allowed in a fleet: one that has");
  }
  if (!robots_.empty() && graph.tick_s != tick_s()) {
    return refuse(
        fmt::format("its tick is {} s, and that of robot {} is {} s; allowed: one for all",
                    graph.tick_s, robots_.front().entry.name, tick_s()));
  }
  const std::uint64_t ticks = robot.plan.setup.max_ticks;
  if (static_cast<double>(ticks) * graph.tick_s > kLongest_s) {
    return refuse(fmt::format("{} ticks of {} s; allowed: {} s (max_ticks)", ticks, graph.tick_s,
                              kLongest_s));
  }
  return {};
}

/// No robot stands in another's disc.
Result<void> FleetPlan::check_places() const {
  for (const RobotPlan& robot : robots_) {
    for (const RobotPlan& other : robots_) {
      if (&other == &robot) continue;
      const double radius_m = robot.plan.setup.behaviour.robot.radius_m;
      const double least_m = radius_m + other.seen_radius_m + kStartGap_m;
      const double apart_m = core::distance_m(robot.entry.start, other.entry.start.position());
      if (apart_m >= least_m) continue;
      return robot.entry.start_place.error(fmt::format(
          "robot {} at [{}, {}] is {:.6g} m from robot {} at [{}, {}]; allowed: {:.6g} m and more, "
          "both radii and the way of a tick",
          robot.entry.name, robot.entry.start.x_m, robot.entry.start.y_m, apart_m, other.entry.name,
          other.entry.start.x_m, other.entry.start.y_m, least_m));
    }
  }
  return {};
}

/// Gives each robot its world, with the others where they start.
Result<void> FleetPlan::place_robots() {
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    std::vector<OtherRobot> others;
    for (std::size_t j = 0; j < robots_.size(); ++j) {
      if (j == i) continue;
      others.push_back({robots_[j].seen_radius_m, {{0.0, robots_[j].entry.start.position()}}});
    }
    auto plan = plan_of(i, robots_[i].entry, others);
    if (!plan.ok()) return of_robot(file_, robots_[i].entry, plan.error());
    auto world = world::World::parse(plan->bundle.at("world.yaml"), file_.world, plan->graph.goals);
    if (!world.ok()) return world.error();
    robots_[i].plan = std::move(plan).value();
    robots_[i].world = std::make_shared<world::World>(std::move(world).value());
    robots_[i].plan.setup.world = robots_[i].world;
  }
  return {};
}

Result<runtime::RunPlan> FleetPlan::alone(std::size_t robot,
                                          const std::vector<OtherRobot>& others) const {
  auto plan = plan_of(robot, robots_[robot].entry, others);
  if (!plan.ok()) return of_robot(file_, robots_[robot].entry, plan.error());
  return plan;
}

Result<runtime::RunPlan> FleetPlan::plan_of(std::size_t index, const RobotEntry& entry,
                                            const std::vector<OtherRobot>& others) const {
  const double radius_m = entry.target_radius_m.value_or(world_->target_radius_m());
  runtime::GraphOverrides overrides;
  overrides.world = file_.world;
  overrides.robot = entry.body;
  overrides.set = entry.set;
  overrides.seed = overrides_.seed ? overrides_.seed : file_.seed;
  overrides.max_ticks = overrides_.max_ticks ? overrides_.max_ticks : file_.max_ticks;
  overrides.robot_index = index;
  overrides.goals = world::Goals{{entry.target, radius_m, entry.target_heading}};
  const RobotSource source(
      source_,
      {file_.world, robot_world_text(*world_, entry.start, {entry.target, radius_m}, others)});
  return runtime::prepare_run(entry.graph, overrides, source, stages_);
}

}  // namespace clew::fleet

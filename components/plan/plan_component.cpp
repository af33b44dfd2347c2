// SPDX-License-Identifier: Apache-2.0
#include "plan/plan_component.hpp"

#include <utility>

#include "world/world.hpp"

namespace clew::plan {

using domain::Topic;

std::vector<runtime::PortInfo> PlanComponent::ports() {
  return {
      runtime::required_input(Topic::kOdometry, "where the robot believes it is; contacts"),
      runtime::required_input(Topic::kScan, "what is around, for a map of what was seen"),
      runtime::output(Topic::kTarget, "where to steer for: a subgoal, or the mission's target")};
}

PlanComponent::PlanComponent(std::unique_ptr<Planner> planner, std::unique_ptr<MapSource> map,
                             const runtime::RunSetup& setup)
    : planner_(std::move(planner)),
      map_(std::move(map)),
      route_(setup.world->waypoints()),
      subgoals_(setup.world->subgoals()) {}

void PlanComponent::step(const runtime::TickInputs& inputs, runtime::TickOutputs& outputs) {
  const auto& odometry = inputs.get<domain::Odometry>();
  {
    const auto part = outputs.part("map");
    map_->see(odometry, inputs.get<domain::Scan>());
  }
  route_.pass(odometry.pose_odom_robot);
  Subgoal subgoal;
  {
    const auto part = outputs.part("planner");
    subgoal = planner_->step(situation(odometry));
  }
  auto& target = outputs.get<domain::Target>();
  target.x_m = subgoal.place.x();
  target.y_m = subgoal.place.y();
  target.radius_m = subgoal.radius_m;
  if (route_.empty()) return;
  target.waypoint = static_cast<std::uint32_t>(route_.passed() + 1);
  target.waypoints = static_cast<std::uint32_t>(route_.size());
  // A subgoal is passed with any heading.
  const world::Waypoint& next = route_.next();
  if (!next.heading || subgoal.place != next.place) return;
  target.has_heading = true;
  target.heading_rad = next.heading->heading_rad;
  target.heading_tolerance_rad = next.heading->tolerance_rad;
}

// The world's subgoals lead to its target; those are none on the way to the points before it.
Situation PlanComponent::situation(const domain::Odometry& odometry) const {
  static const std::vector<core::Vec2> kNone;
  if (route_.empty()) return {odometry, *map_, odometry.pose_odom_robot.position(), 0.0, kNone};
  const bool is_last = route_.passed() + 1 == route_.size();
  const world::Waypoint& next = route_.next();
  return {odometry, *map_, next.place, next.radius_m, is_last ? subgoals_ : kNone};
}

void PlanComponent::save(core::StateWriter& writer) const {
  map_->save(writer);
  planner_->save(writer);
  route_.save(writer);
}

void PlanComponent::load(core::StateReader& reader) {
  map_->load(reader);
  planner_->load(reader);
  route_.load(reader);
}

}  // namespace clew::plan

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
      target_(setup.world->target()),
      target_radius_m_(setup.world->target_radius_m()),
      subgoals_(setup.world->subgoals()) {}

void PlanComponent::step(const runtime::TickInputs& inputs, runtime::TickOutputs& outputs) {
  const auto& odometry = inputs.get<domain::Odometry>();
  map_->see(odometry, inputs.get<domain::Scan>());
  const Subgoal subgoal = planner_->step({odometry, *map_, target_, target_radius_m_, subgoals_});
  auto& target = outputs.get<domain::Target>();
  target.x_m = subgoal.place.x();
  target.y_m = subgoal.place.y();
  target.radius_m = subgoal.radius_m;
}

void PlanComponent::save(core::StateWriter& writer) const {
  map_->save(writer);
  planner_->save(writer);
}

void PlanComponent::load(core::StateReader& reader) {
  map_->load(reader);
  planner_->load(reader);
}

}  // namespace clew::plan

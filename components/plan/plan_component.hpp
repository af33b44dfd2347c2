// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "plan/map_source.hpp"
#include "plan/planner.hpp"
#include "runtime/component.hpp"
#include "runtime/stage.hpp"
#include "world/route.hpp"

namespace clew::plan {

/// Writes the target in drive's place: subgoals on the way to the mission's target, which it knows
/// from the run's set-up as drive does. Drive still judges by that one. Of a mission of several
/// way-points it leads to the next, which follows from odometry.
class PlanComponent final : public runtime::Component {
 public:
  static std::vector<runtime::PortInfo> ports();

  PlanComponent(std::unique_ptr<Planner> planner, std::unique_ptr<MapSource> map,
                const runtime::RunSetup& setup);

  void step(const runtime::TickInputs& inputs, runtime::TickOutputs& outputs) override;
  void save(core::StateWriter& writer) const override;
  void load(core::StateReader& reader) override;
  void tell(const runtime::TickInputs& samples, domain::Inside& inside) const override;

 private:
  /// What the planner is to lead to.
  Situation situation(const domain::Odometry& odometry) const;
  void tell_room(const core::Vec2& robot, const core::Vec2& target, domain::Inside& inside) const;

  std::unique_ptr<Planner> planner_;
  std::unique_ptr<MapSource> map_;
  world::Route route_;  ///< as far as the robot believes to have come
  std::vector<core::Vec2> subgoals_;
};

}  // namespace clew::plan

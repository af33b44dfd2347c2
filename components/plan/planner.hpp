// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/archive.hpp"
#include "domain/inside.hpp"
#include "domain/messages.hpp"
#include "plan/map_source.hpp"

namespace clew::plan {

/// What a planner goes by in a tick. All places are in the odometry frame, which the map is taken
/// to be in, as the mission's target is.
struct Situation {
  const domain::Odometry& odometry;
  MapSource& map;
  core::Vec2 target;
  double target_radius_m = 0.0;
  const std::vector<core::Vec2>& subgoals;  ///< that the world gives on the way, in order
};

/// Where to steer for.
struct Subgoal {
  core::Vec2 place = core::Vec2::Zero();
  double radius_m = 0.0;  ///< arrival within this distance
};

/// Leads to the mission's target by places that can be steered for.
class Planner {
 public:
  virtual ~Planner() = default;

  /// Called once a tick. The mission's target itself if it knows no way.
  virtual Subgoal step(const Situation& situation) = 0;

  /// Tells what led to the subgoal of the last step, which was given this situation.
  virtual void tell(const Situation&, domain::Inside&) const {}

  virtual void save(core::StateWriter& writer) const = 0;
  virtual void load(core::StateReader& reader) = 0;
};

}  // namespace clew::plan

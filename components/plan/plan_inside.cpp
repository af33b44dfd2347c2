// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "domain/words.hpp"
#include "plan/plan_component.hpp"

namespace clew::plan {
namespace {

// What is told of the map lies within this distance of the robot.
constexpr double kWindow_m = 4.0;
// No more places than this along a side.
constexpr std::size_t kMostPlaces = 64;

}  // namespace

void PlanComponent::tell(const runtime::TickInputs& samples, domain::Inside& inside) const {
  const auto& odometry = samples.get<domain::Odometry>();
  const auto& target = samples.get<domain::Target>();
  const core::Vec2 robot = odometry.pose_odom_robot.position();
  const Situation now = situation(odometry);
  const bool straight = core::length(target.position() - now.target) == 0.0;
  inside.say("The mission's target is " + domain::say_metres(core::length(now.target - robot)) +
             " away. " +
             (straight
                  ? "The subgoal is that target itself."
                  : "The subgoal is " + domain::say_place(target.position()) + ", " +
                        domain::say_metres(core::length(target.position() - robot)) + " away, " +
                        domain::say_bearing(
                            core::bearing_rad(odometry.pose_odom_robot, target.position())) +
                        "."));
  inside.values.place("subgoal", target.position());
  inside.values.number("subgoal_radius", target.radius_m, "m");
  inside.values.flag("subgoal_is_target", straight);
  inside.picture.layers.push_back(
      {"subgoal", domain::PictureLayer::Kind::kGoal, {}, {target.position()}});
  tell_room(robot, now.target, inside);
  domain::Inside part;
  planner_->tell(now, part);
  inside.add("planner", std::move(part));
}

/// The room around the robot, as the map has it: 0 inside an obstacle .. 4 open.
void PlanComponent::tell_room(const core::Vec2& robot, const core::Vec2& target,
                              domain::Inside& inside) const {
  const RoomView view = map_->read(robot, target);
  const double cell_m = view.grid.cell_m;
  const auto reach = std::min(static_cast<std::size_t>(std::ceil(kWindow_m / cell_m)), kMostPlaces);
  const double step_m = kWindow_m / static_cast<double>(reach);
  domain::InsideGrid room{2 * reach + 1, {}, "x, m", "y, m, from the top", {}};
  for (std::size_t row = 0; row <= 2 * reach; ++row) {
    for (std::size_t column = 0; column <= 2 * reach; ++column) {
      const core::Vec2 place = robot + core::Vec2(static_cast<double>(column) * step_m - kWindow_m,
                                                  kWindow_m - static_cast<double>(row) * step_m);
      const auto cell = view.grid.cell_at(place);
      const map::Clearance clearance =
          cell ? view.room[view.grid.index(*cell)] : map::Clearance::kOpen;
      room.values.push_back(static_cast<double>(clearance));
    }
  }
  room.marked = room.values.size() / 2;
  inside.values.grid("room_around_robot", std::move(room));
}

}  // namespace clew::plan

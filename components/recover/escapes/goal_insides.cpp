// SPDX-License-Identifier: Apache-2.0
/// What the escapes that keep a stack of goals tell.
#include "domain/words.hpp"
#include "recover/escapes/box_filling.hpp"
#include "recover/escapes/goal_stack.hpp"
#include "recover/escapes/local_minimum_planner.hpp"

namespace clew::recover {
namespace {

domain::PictureCell cell_of(const domain::VirtualObstacle& box) {
  return {{core::Vec2(box.x_min_m, box.y_min_m), core::Vec2(box.x_max_m, box.y_min_m),
           core::Vec2(box.x_max_m, box.y_max_m), core::Vec2(box.x_min_m, box.y_max_m)},
          0.0};
}

}  // namespace

void GoalStack::tell(const Situation& situation, domain::Inside& inside) const {
  domain::PictureLayer goals{"stack of goals", domain::PictureLayer::Kind::kGoal, {}, {}};
  for (std::size_t i = state_.goals.size(); i-- > 0;) {
    const Goal& goal = state_.goals[i];
    domain::InsideGroup& item = inside.values.item("goal_stack");
    item.place("place", goal.position_odom);
    item.number("distance", core::distance_m(situation.pose(), goal.position_odom), "m");
    item.bound("least_distance", goal.least_m, "m");
    item.number("without_progress", static_cast<double>(situation.tick - goal.progress_tick),
                "ticks");
    goals.places_odom.push_back(goal.position_odom);
  }
  inside.values.number("patience", patience_ticks_, "ticks");
  if (state_.goals.empty()) {
    inside.say("The stack of goals is empty.");
    return;
  }
  inside.say("The stack holds " + domain::say_count(state_.goals.size(), "goal") +
             "; the newest is " +
             domain::say_metres(core::distance_m(situation.pose(), top_odom())) + " away, " +
             domain::say_bearing(core::bearing_rad(situation.pose(), top_odom())) + ".");
  inside.picture.layers.push_back(std::move(goals));
}

void BoxFilling::tell(const Situation& situation, domain::Inside& inside) const {
  domain::PictureLayer boxes{"virtual obstacles", domain::PictureLayer::Kind::kBlocked, {}, {}};
  for (const VirtualObstacle& box : state_.boxes) {
    domain::InsideGroup& item = inside.values.item("boxes");
    item.number("x_min", box.x_min_m, "m");
    item.number("y_min", box.y_min_m, "m");
    item.number("x_max", box.x_max_m, "m");
    item.number("y_max", box.y_max_m, "m");
    boxes.cells.push_back(cell_of(box));
  }
  inside.say(domain::say_count(state_.boxes.size(), "virtual obstacle") + " fill the trap.");
  domain::PictureLayer trail{"path back", domain::PictureLayer::Kind::kWay, {}, {}};
  for (const Trail::Point& point : trail_.points())
    trail.places_odom.push_back(point.position_odom);
  inside.values.number("trail_points", static_cast<double>(trail.places_odom.size()));
  inside.values.bound("nearest_to_target", state_.target_least_m, "m");
  stack_.tell(situation, inside);
  inside.picture.layers.push_back(std::move(boxes));
  inside.picture.layers.push_back(std::move(trail));
}

void LocalMinimumPlanner::tell(const Situation& situation, domain::Inside& inside) const {
  stack_.tell(situation, inside);
  for (const core::Vec2& had : state_.had_odom) {
    domain::InsideGroup& item = inside.values.item("virtual_targets_so_far");
    item.number("x", had.x(), "m");
    item.number("y", had.y(), "m");
  }
  inside.say("It has set " + domain::say_count(state_.had_odom.size(), "virtual target") +
             " so far.");
}

}  // namespace clew::recover

// SPDX-License-Identifier: Apache-2.0
#include "control/reactions/give_way.hpp"
#include "domain/words.hpp"

namespace clew::control {

void GiveWay::tell(const domain::Odometry& odometry, const domain::Scan& scan,
                   const domain::Landmark& landmark, const domain::Motion& wanted,
                   domain::Inside& inside) const {
  const std::vector<Mover> all = movers(scan, landmark);
  const Course course = course_of(wanted);
  inside.values.number("movers", static_cast<double>(all.size()));
  inside.values.number("keep", parameters_.keep_m, "m");
  if (all.empty()) {
    inside.say("Nothing comes near, so there is nobody to give way to.");
    return;
  }
  const double left_m = clearance_m(course, all);
  inside.values.number("clearance_as_wanted", left_m, "m");
  inside.say("Of " + domain::say_count(all.size(), "moving object") + ", the nearest will leave " +
             domain::say_metres(left_m) + " if the robot moves as it wants to.");
  const core::Pose2& pose = odometry.pose_odom_robot;
  const core::Vec2 ahead = core::direction(pose.heading_rad);
  for (const Mover& mover : all) {
    const auto place = [&](const core::Vec2& at) {
      return core::Vec2(pose.position() + at.x() * ahead +
                        at.y() * core::Vec2(-ahead.y(), ahead.x()));
    };
    inside.picture.layers.push_back(
        {"way of a moving object",
         domain::PictureLayer::Kind::kWay,
         {},
         {place(mover.centre_robot),
          place(mover.centre_robot + parameters_.horizon_s * mover.velocity_robot_mps)}});
  }
  if (left_m >= parameters_.keep_m) return;
  const Choice choice = choose(course, all, scan);
  inside.values.number("clearance_chosen", choice.clearance_m, "m");
  inside.values.number("deviation", choice.deviation_rad, "rad");
  inside.say(std::string(choice.course.speed_mps == 0.0 ? "Waiting" : "Going aside") + " leaves " +
             domain::say_metres(choice.clearance_m) + ".");
}

}  // namespace clew::control

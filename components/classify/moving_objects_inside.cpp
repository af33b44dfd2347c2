// SPDX-License-Identifier: Apache-2.0
#include "classify/moving_objects.hpp"
#include "domain/words.hpp"

namespace clew::classify {

void MovingObjects::tell(const domain::Odometry& odometry, const domain::Scan&,
                         domain::Inside& inside) const {
  const std::size_t followed = tracks_.state().tracks.size();
  const std::vector<Known> all = known(odometry.stamp.tick, odometry.pose_odom_robot);
  inside.values.number("spatial_class", sequence_.current().spatial_class);
  inside.values.number("objects_followed", static_cast<double>(followed));
  inside.values.number("objects_known", static_cast<double>(all.size()));
  inside.say("It follows " + domain::say_count(followed, "object") + " and knows the motion of " +
             std::to_string(all.size()) + ".");
  domain::PictureLayer moving{"moving objects", domain::PictureLayer::Kind::kGoal, {}, {}};
  domain::PictureLayer standing{"static objects", domain::PictureLayer::Kind::kPoints, {}, {}};
  for (const Known& one : all) {
    const double speed_mps = core::length(one.course.velocity_odom_mps);
    domain::InsideGroup& item = inside.values.item("objects");
    item.text("motion", domain::object_motion_name(one.object.motion));
    item.place("centre", one.course.centre_odom);
    item.number("bearing", one.object.bearing_rad, "rad");
    item.number("range", one.object.ranges_m[2], "m");
    item.number("width", one.width_m, "m");
    item.number("speed", speed_mps, "mps");
    item.number("off_its_line", one.course.error_m, "m");
    const bool moves = one.object.motion != domain::ObjectMotion::kStatic;
    (moves ? moving : standing).places_odom.push_back(one.course.centre_odom);
    if (!moves) continue;
    inside.say("An object " + domain::say_metres(one.object.ranges_m[2]) + " away, " +
               domain::say_bearing(one.object.bearing_rad) + ", is " +
               domain::object_motion_name(one.object.motion) + " at " +
               domain::say_number(speed_mps) + " m/s.");
    inside.picture.layers.push_back(
        {"course in the next second",
         domain::PictureLayer::Kind::kWay,
         {},
         {one.course.centre_odom, one.course.centre_odom + one.course.velocity_odom_mps}});
  }
  if (!moving.places_odom.empty()) inside.picture.layers.push_back(std::move(moving));
  if (!standing.places_odom.empty()) inside.picture.layers.push_back(std::move(standing));
}

}  // namespace clew::classify

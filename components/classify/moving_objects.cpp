// SPDX-License-Identifier: Apache-2.0
#include "classify/moving_objects.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scan/scan_needs.hpp"

namespace clew::classify {
namespace {

using domain::ObjectMotion;

constexpr char kName[] = "classify moving_objects";

}  // namespace

core::Result<std::unique_ptr<MovingObjects>> MovingObjects::create(
    const Parameters& parameters, const domain::BehaviourSetup& setup) {
  CLEW_RETURN_IF_ERROR(scan::SevenCones::check(setup.scan, kName));
  scan::ScanNeeds needs;
  needs.most_apart_rad = core::radians(5.0);
  CLEW_RETURN_IF_ERROR(scan::check_needs(needs, setup.scan, kName));
  return std::make_unique<MovingObjects>(parameters, setup.robot.radius_m, setup.tick_s);
}

MovingObjects::MovingObjects(const Parameters& parameters, double robot_radius_m, double tick_s)
    : parameters_(parameters),
      robot_radius_m_(robot_radius_m),
      tracks_(parameters.tracks, tick_s) {}

void MovingObjects::step(const domain::Odometry& odometry, const domain::Scan& scan,
                         domain::Landmark& landmark) {
  sequence_.add(spatial_class(nearness(eyes_.see(scan), {}), {}));
  landmark.spatial_class = sequence_.current().spatial_class;
  landmark.run_length = sequence_.current().length;

  const std::uint64_t tick = odometry.stamp.tick;
  find_objects(scan, robot_radius_m_, parameters_.pattern, seen_);
  tracks_.add(tick, odometry.pose_odom_robot, seen_);
  for (const Known& one : known(tick, odometry.pose_odom_robot)) {
    if (landmark.recognitions.full()) break;
    landmark.recognitions.push_back(domain::to_recognition(one.object, scan.range_max_m));
  }
}

/// All objects whose motion is known: what moves before what stands, the nearest first.
std::vector<MovingObjects::Known> MovingObjects::known(std::uint64_t tick,
                                                       const core::Pose2& pose_odom_robot) const {
  std::vector<Known> all;
  for (const ObjectTracks::Track& track : tracks_.state().tracks) {
    const auto course = tracks_.course(track, tick);
    if (!course) continue;
    Known one;
    one.course = *course;
    one.width_m = track.width_m;
    one.object.motion = motion_of(*course, pose_odom_robot.position());
    one.object.bearing_rad = core::bearing_rad(pose_odom_robot, course->centre_odom);
    const bool moves = one.object.motion != ObjectMotion::kStatic;
    for (std::size_t i = 0; i < one.object.ranges_m.size(); ++i) {
      const double before_s =
          moves ? static_cast<double>(2 - i) * domain::MovingObject::kPatternStep_s : 0.0;
      const core::Vec2 centre_odom = course->centre_odom - before_s * course->velocity_odom_mps;
      one.object.ranges_m[i] =
          std::max(0.0, core::distance_m(pose_odom_robot, centre_odom) - robot_radius_m_);
    }
    all.push_back(one);
  }
  std::stable_sort(all.begin(), all.end(), [](const Known& a, const Known& b) {
    const auto rank = [](const Known& one) {
      return std::make_pair(one.object.motion == ObjectMotion::kStatic, one.object.ranges_m[2]);
    };
    return rank(a) < rank(b);
  });
  return all;
}

ObjectMotion MovingObjects::motion_of(const ObjectTracks::Course& course,
                                      const core::Vec2& robot_odom) const {
  const core::Vec2& velocity = course.velocity_odom_mps;
  const double speed_mps = core::length(velocity);
  if (speed_mps < parameters_.moving_mps || course.error_m > parameters_.steady_m) {
    return ObjectMotion::kStatic;
  }
  const core::Vec2 sight = course.centre_odom - robot_odom;
  const double along = sight.x() * velocity.x() + sight.y() * velocity.y();
  const double across = sight.x() * velocity.y() - sight.y() * velocity.x();
  const double off_rad = core::atan2(std::fabs(across), std::fabs(along));
  if (off_rad <= parameters_.along_rad) {
    return along < 0.0 ? ObjectMotion::kApproaching : ObjectMotion::kReceding;
  }
  return across > 0.0 ? ObjectMotion::kCrossingLeft : ObjectMotion::kCrossingRight;
}

void MovingObjects::save(core::StateWriter& writer) const {
  writer(sequence_.state(), tracks_.state());
}

void MovingObjects::load(core::StateReader& reader) {
  reader(sequence_.state(), tracks_.state());
  if (!reader.check(sequence_.is_valid(), "there is no such class")) sequence_.state() = {};
  if (!reader.check(tracks_.is_valid(), "the sightings of an object are not in order")) {
    tracks_.state() = {};
  }
}

}  // namespace clew::classify

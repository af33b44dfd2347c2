// SPDX-License-Identifier: Apache-2.0
#include "control/reactions/give_way.hpp"

#include <algorithm>
#include <cmath>

#include "domain/motion_conversion.hpp"
#include "scan/certain_block.hpp"

namespace clew::control {
namespace {

using domain::ObjectMotion;

// Of drives without limits.
constexpr double kWalkingPace_mps = 1.0;
constexpr double kTurnFirst_rad = core::radians(30.0);
constexpr double kAhead_s = 1.0;  // for which a direction must be clear of what stands

/// The least distance from the origin of what is at `from` and moves steadily for `duration_s`.
double least_distance_m(const core::Vec2& from, const core::Vec2& velocity_mps, double duration_s) {
  const double squared = velocity_mps.x() * velocity_mps.x() + velocity_mps.y() * velocity_mps.y();
  const double along = from.x() * velocity_mps.x() + from.y() * velocity_mps.y();
  const double nearest_s = squared > 0.0 ? std::clamp(-along / squared, 0.0, duration_s) : 0.0;
  return core::length(from + nearest_s * velocity_mps);
}

}  // namespace

core::Result<std::unique_ptr<GiveWay>> GiveWay::create(const Parameters& parameters,
                                                       const domain::BehaviourSetup& setup) {
  return std::make_unique<GiveWay>(parameters, setup);
}

GiveWay::GiveWay(const Parameters& parameters, const domain::BehaviourSetup& setup)
    : parameters_(parameters),
      radius_m_(setup.robot.radius_m),
      tick_s_(setup.tick_s),
      speed_mps_(std::min(setup.limits.speed_mps, kWalkingPace_mps)),
      turn_rate_radps_(std::min(setup.limits.turn_rate_radps, core::kPi / setup.tick_s)) {}

std::optional<domain::Motion> GiveWay::react(const domain::Odometry&, const domain::Scan& scan,
                                             const domain::Landmark& landmark,
                                             const domain::Motion& wanted) {
  const std::vector<Mover> all = movers(scan, landmark);
  const Course course = course_of(wanted);
  if (clearance_m(course, all) >= parameters_.keep_m) return std::nullopt;
  return motion_of(choose(course, all, scan).course);
}

/// What may come nearer.
std::vector<GiveWay::Mover> GiveWay::movers(const domain::Scan& scan,
                                            const domain::Landmark& landmark) const {
  std::vector<Mover> all;
  if (landmark.presented) return all;  // then the recognitions are of landmarks
  for (const domain::Recognition& recognition : landmark.recognitions) {
    const auto object = domain::to_moving_object(recognition, scan.range_max_m);
    if (!object || object->motion == ObjectMotion::kStatic ||
        object->motion == ObjectMotion::kReceding) {
      continue;
    }
    const double distance_m = object->ranges_m[2] + radius_m_;
    all.push_back({*object, distance_m * core::direction(object->bearing_rad),
                   object->velocity_robot_mps(radius_m_)});
  }
  return all;
}

GiveWay::Course GiveWay::course_of(const domain::Motion& motion) const {
  const domain::Motion asked = domain::to_turn_and_step(motion, tick_s_, 2.0 * radius_m_);
  const double speed_mps = std::clamp(asked.step_m / tick_s_, 0.0, speed_mps_);
  return {core::wrap_angle_rad(asked.turn_rad), speed_mps};
}

/// How near a mover comes to the robot's skin at the worst, up to the horizon. Infinite without
/// movers.
double GiveWay::clearance_m(const Course& course, const std::vector<Mover>& movers) const {
  const double turning_s =
      std::min(std::fabs(course.turn_rad) / turn_rate_radps_, parameters_.horizon_s);
  const core::Vec2 going_mps = course.speed_mps * core::direction(course.turn_rad);
  double least_m = std::numeric_limits<double>::infinity();
  for (const Mover& mover : movers) {
    const core::Vec2 then = mover.centre_robot + turning_s * mover.velocity_robot_mps;
    least_m = std::min({least_m,
                        least_distance_m(mover.centre_robot, mover.velocity_robot_mps, turning_s),
                        least_distance_m(then, mover.velocity_robot_mps - going_mps,
                                         parameters_.horizon_s - turning_s)});
  }
  return least_m - radius_m_ - parameters_.object_radius_m;
}

GiveWay::Choice GiveWay::choose(const Course& wanted, const std::vector<Mover>& movers,
                                const domain::Scan& scan) const {
  const auto judged = [&](const Course& course, double deviation_rad) {
    return Choice{course, clearance_m(course, movers), deviation_rad};
  };
  Choice best = judged({}, parameters_.waiting_rad);
  for (int i = 0; i < kDirections; ++i) {
    const double off_rad = 2.0 * core::kPi * static_cast<double>(i) / kDirections;
    const double turn_rad = core::wrap_angle_rad(wanted.turn_rad + off_rad);
    if (!scan::is_in_view(scan, turn_rad) ||
        scan::is_certainly_blocked(scan, radius_m_, turn_rad, kAhead_s * speed_mps_)) {
      continue;
    }
    const Choice choice = judged({turn_rad, speed_mps_}, std::fabs(core::wrap_angle_rad(off_rad)));
    if (is_better(choice, best)) best = choice;
  }
  return best;
}

bool GiveWay::is_better(const Choice& a, const Choice& b) const {
  const bool a_keeps = a.clearance_m >= parameters_.keep_m;
  const bool b_keeps = b.clearance_m >= parameters_.keep_m;
  if (a_keeps != b_keeps) return a_keeps;
  return a_keeps ? a.deviation_rad < b.deviation_rad : a.clearance_m > b.clearance_m;
}

domain::Motion GiveWay::motion_of(const Course& course) const {
  domain::Motion motion;
  motion.kind = domain::CommandKind::kTurnAndStep;
  const double most_rad = turn_rate_radps_ * tick_s_;
  motion.turn_rad = std::clamp(course.turn_rad, -most_rad, most_rad);
  const double left_rad = std::fabs(course.turn_rad - motion.turn_rad);
  if (left_rad <= kTurnFirst_rad) motion.step_m = course.speed_mps * tick_s_;
  return motion;
}

}  // namespace clew::control

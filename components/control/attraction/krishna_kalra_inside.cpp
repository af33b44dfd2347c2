// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <string>

#include "control/attraction/krishna_kalra_fuzzy.hpp"
#include "core/angle.hpp"
#include "domain/words.hpp"

namespace clew::control {
namespace {

// Values along each axis of the control surface.
constexpr std::size_t kSurface = 21;

/// A turn of the paper, clockwise positive.
std::string say_clockwise(double turn_rad) {
  if (core::degrees(std::fabs(turn_rad)) < 0.5) return "no turn";
  return "turn " + domain::say_bearing(-turn_rad);
}

}  // namespace

void KrishnaKalraFuzzy::tell(const domain::Odometry& odometry, const domain::Scan& scan,
                             const core::Vec2& target_odom, domain::Inside& inside) const {
  Readings u{};
  std::vector<double> nearness;
  for (std::size_t i = 0; i < u.size(); ++i) {
    u[i] = scan.ranges_m[i] / scan.range_max_m;
    nearness.push_back(near(u[i]));
  }
  const core::Pose2& pose = odometry.pose_odom_robot;
  // The side that a target behind is kept on was fixed by the step itself.
  KrishnaKalraFuzzy after = *this;
  const double angle_rad = after.keep_side_behind(-core::bearing_rad(pose, target_odom));
  const double u_t = std::min(1.0, core::distance_m(pose, target_odom) / scan.range_max_m);
  const double w1 = target_weight(u);
  const double left = near(std::min({u[0], u[1], u[2]}));
  const double right = near(std::min({u[4], u[5], u[6]}));
  inside.values.list("readings_of_range", {u.begin(), u.end()});
  inside.values.list("near_memberships", std::move(nearness));
  inside.values.number("near_left", left);
  inside.values.number("near_ahead", near(u[3]));
  inside.values.number("near_right", right);
  domain::InsideGroup& target = inside.values.group("target_module");
  target.number("strength_w1", w1);
  target.number("difference_angle", angle_rad, "rad");
  target.number("turn_clockwise", target_turn_rad(angle_rad), "rad");
  target.number("step", target_step_m(u_t), "m");
  domain::InsideGroup& obstacle = inside.values.group("obstacle_module");
  obstacle.number("strength_w2", 1.0 - w1);
  obstacle.number("turn_clockwise", obstacle_turn_rad(u), "rad");
  obstacle.number("step", obstacle_step_m(u), "m");
  domain::InsideGroup& strengths = inside.values.group("strengths");
  for (std::size_t i = 0; i < u.size(); ++i) {
    strengths.number("reading_" + std::to_string(i + 1), (1.0 - w1) * near(u[i]));
  }
  strengths.number("target", w1);
  tell_surface(u, angle_rad, inside);
  inside.say("Obstacles are near to " + domain::say_percent(left) + " on the left, " +
             domain::say_percent(near(u[3])) + " ahead and " + domain::say_percent(right) +
             " on the right. So reaching the target weighs " + domain::say_percent(w1) + " (" +
             say_clockwise(target_turn_rad(angle_rad)) + ") and avoiding obstacles " +
             domain::say_percent(1.0 - w1) + " (" + say_clockwise(obstacle_turn_rad(u)) + ").");
}

/// The turn for any reading of the three sensors on the left and on the right, all else as it is.
void KrishnaKalraFuzzy::tell_surface(const Readings& u, double difference_angle_rad,
                                     domain::Inside& inside) const {
  domain::InsideGrid surface{
      kSurface, {}, "left readings, share of range", "right readings, share of range", {}};
  const auto place = [](double share) {
    return static_cast<std::size_t>(share * static_cast<double>(kSurface - 1) + 0.5);
  };
  for (std::size_t row = 0; row < kSurface; ++row) {
    for (std::size_t column = 0; column < kSurface; ++column) {
      Readings there = u;
      for (std::size_t i = 0; i < 3; ++i) {
        there[i] = static_cast<double>(column) / static_cast<double>(kSurface - 1);
        there[i + 4] = static_cast<double>(row) / static_cast<double>(kSurface - 1);
      }
      const double w1 = target_weight(there);
      surface.values.push_back(
          -(w1 * target_turn_rad(difference_angle_rad) + (1.0 - w1) * obstacle_turn_rad(there)));
    }
  }
  surface.marked =
      place(std::min({u[4], u[5], u[6]})) * kSurface + place(std::min({u[0], u[1], u[2]}));
  inside.values.grid("turn_surface", std::move(surface), "rad");
}

}  // namespace clew::control

// SPDX-License-Identifier: Apache-2.0
#include "control/attraction/krishna_kalra_fuzzy.hpp"

#include <algorithm>
#include <cmath>

#include "core/fuzzy.hpp"
#include "scan/seven_cones.hpp"

namespace clew::control {
core::Result<std::unique_ptr<KrishnaKalraFuzzy>> KrishnaKalraFuzzy::create(
    const Parameters& parameters, const domain::BehaviourSetup& setup) {
  if (!scan::SevenCones::are(setup.scan)) {
    return core::Error{
        "krishna_kalra_fuzzy needs seven beams, 15 degrees apart from 45 on the left "
        "to 45 on the right; '" +
        setup.scan.sensor + "' gives " + std::to_string(setup.scan.beam_count) +
        " of another arrangement"};
  }
  const auto resource = setup.resources.find("rulebases", parameters.rules);
  if (!resource.ok()) return resource.error();
  const auto rules = KrishnaKalraRules::parse(*resource);
  if (!rules.ok()) return rules.error();
  return std::make_unique<KrishnaKalraFuzzy>(parameters, *rules);
}

domain::Motion KrishnaKalraFuzzy::step(const domain::Odometry& odometry, const domain::Scan& scan,
                                       const core::Vec2& target_odom) {
  Readings u{};
  for (std::size_t i = 0; i < u.size(); ++i) u[i] = scan.ranges_m[i] / scan.range_max_m;
  const core::Pose2& pose = odometry.pose_odom_robot;
  const double difference_angle_rad = keep_side_behind(-core::bearing_rad(pose, target_odom));
  const double u_t = std::min(1.0, core::distance_m(pose, target_odom) / scan.range_max_m);

  const double w1 = target_weight(u);
  const double w2 = 1.0 - w1;
  const double y = w1 * target_turn_rad(difference_angle_rad) + w2 * obstacle_turn_rad(u);  // eq. 7
  const double s = w1 * target_step_m(u_t) + w2 * obstacle_step_m(u);                       // eq. 8

  domain::Motion motion;
  motion.kind = domain::CommandKind::kTurnAndStep;
  motion.turn_rad = -y;  // the paper's turns are clockwise positive
  motion.step_m = s;
  return motion;
}

double KrishnaKalraFuzzy::near(double u) const {
  return core::falling_membership(u, rules_.near_full_ratio, rules_.near_none_ratio);
}

double KrishnaKalraFuzzy::target_turn_rad(double difference_angle_rad) const {
  const double c = rules_.target_turn_rad;
  if (parameters_.target_turn == TargetTurn::kClipped) {
    return std::clamp(difference_angle_rad, -c, c);
  }
  if (difference_angle_rad == 0.0) return 0.0;
  return difference_angle_rad > 0.0 ? c : -c;
}

double KrishnaKalraFuzzy::obstacle_turn_rad(const Readings& u) const {
  double sum_rad = 0.0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    sum_rad += rules_.near_turns_rad[i] * near(u[i]) + rules_.far_turns_rad[i] * (1.0 - near(u[i]));
  }
  return sum_rad / static_cast<double>(u.size());  // near + far = 1 for each sensor
}

double KrishnaKalraFuzzy::target_step_m(double u_t) const {
  return rules_.target_near_step_m * near(u_t) + rules_.target_far_step_m * (1.0 - near(u_t));
}

double KrishnaKalraFuzzy::obstacle_step_m(const Readings& u) const {
  // max near = near(min u) and min far = 1 - max near, so the denominator of eq. 10 is 1.
  const double nearest = near(*std::min_element(u.begin(), u.end()));
  return rules_.obstacle_near_step_m * nearest + rules_.obstacle_far_step_m * (1.0 - nearest);
}

double KrishnaKalraFuzzy::target_weight(const Readings& u) const {
  const double left = std::min({u[0], u[1], u[2]});
  const double right = std::min({u[4], u[5], u[6]});
  return (1.0 - near(left)) * (1.0 - near(u[3])) * (1.0 - near(right));
}

/// A target almost straight behind changes sides with every small turn, and the robot would turn to
/// and fro: it keeps the side on which it was last seen clearly.
double KrishnaKalraFuzzy::keep_side_behind(double difference_angle_rad) {
  const bool on_right = difference_angle_rad > 0.0;
  if (std::fabs(difference_angle_rad) < core::kPi - parameters_.behind_band_rad) {
    state_.target_on_right = on_right;
    return difference_angle_rad;
  }
  if (on_right == state_.target_on_right) return difference_angle_rad;
  return state_.target_on_right ? core::kPi : -core::kPi;
}

void KrishnaKalraFuzzy::save(core::StateWriter& writer) const { writer(state_); }

void KrishnaKalraFuzzy::load(core::StateReader& reader) { reader(state_); }

}  // namespace clew::control

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "core/geometry.hpp"
#include "core/random.hpp"
#include "domain/messages.hpp"
#include "drive/motion_errors.hpp"

namespace clew::drive {

struct DriftParameters : MotionErrors {};

template <typename Visitor>
void visit_parameters(Visitor& visit, DriftParameters& p) {
  visit.number("drift_m_per_m", p.m_per_m, "m/m", {-0.5, 0.5},
               "systematic error of the distance, for each metre travelled");
  visit.number("drift_rad_per_rad", p.rad_per_rad, "rad/rad", {-0.5, 0.5},
               "systematic error of the heading, for each radian turned");
  visit.number("drift_rad_per_m", p.rad_per_m, "rad/m", {-0.5, 0.5},
               "systematic error of the heading, for each metre travelled");
  visit.number("drift_m_per_sqrt_m", p.m_per_sqrt_m, "m/m^0.5", {0.0, 0.5},
               "standard deviation of the distance after a metre");
  visit.number("drift_rad_per_sqrt_rad", p.rad_per_sqrt_rad, "rad/rad^0.5", {0.0, 0.5},
               "standard deviation of the heading after a radian turned");
  visit.number("drift_rad_per_sqrt_m", p.rad_per_sqrt_m, "rad/m^0.5", {0.0, 0.5},
               "standard deviation of the heading after a metre");
}

/// Where the robot believes it is: what its wheels count, summed from the start, where belief and
/// truth are one.
///
/// Of a tick in which its wheels made s metres and a turn of theta, which is the truth unless they
/// slip, it counts
///
///     s'     = s (1 + m_per_m) + m_per_sqrt_m sqrt(s) N_0
///     theta' = theta (1 + rad_per_rad) + rad_per_m s + rad_per_sqrt_m sqrt(s) N_1
///              + rad_per_sqrt_rad sqrt(|theta|) N_2
///
/// with N_i standard normal. The variances grow in proportion to the way, so the drift of a path
/// does not depend on how it is cut into ticks. Without errors belief is the truth, to the bit.
///
/// It tells how far it may be off as dead reckoning does: first-order propagation of covariance
/// through the motion model (Kelly 2004, "Linearized error propagation in odometry", IJRR 23(2);
/// Thrun, Burgard & Fox 2005, section 5.4). With d = (dx, dy) the tick's way as believed, odom
/// frame,
///
///     F   = [[1, 0, -dy], [0, 1, dx], [0, 0, 1]]   3 x 3, of the pose before
///     g_s = (dx, dy, 0) / s'                        3, of an error of the distance
///     g_t = (-dy/2, dx/2, 1)                        3, of an error of the heading
///     P   = F P F^T + var_s g_s g_s^T + var_t g_t g_t^T
///     var_s = m_per_sqrt_m^2 s'                     m^2
///     var_t = rad_per_sqrt_m^2 s' + rad_per_sqrt_rad^2 |theta'|   rad^2
///
/// with what was counted (s', theta') in the place of the truth, which no robot knows. A systematic
/// error is the same in every tick, so it adds up otherwise than noise: the robot knows how large
/// it is, and not its sign. Each of the three has a vector b, where the pose is after that error:
/// b = F b + its error in the tick times g_s or g_t. The covariance told is P + the sum of b b^T.
/// Wheels that slip are errors of the same kinds: their variances and sizes are added to these.
class DeadReckoning {
 public:
  static constexpr std::size_t kSystematic = 3;  ///< m_per_m, rad_per_rad, rad_per_m

  /// An error of the pose: m, m, rad.
  struct PoseError {
    double x_m = 0.0;
    double y_m = 0.0;
    double heading_rad = 0.0;
  };
  struct State {
    core::Pose2 pose_odom_robot;
    double travel_m = 0.0;
    double speed_mps = 0.0;
    double turn_rate_radps = 0.0;
    domain::PoseCovariance noise;                     ///< P
    std::array<PoseError, kSystematic> systematic{};  ///< b

    /// Whether it is one that counting leads to, and not a stranger's.
    bool is_sound() const;
  };
  /// What happened in a tick: poses in the world's frame, in truth.
  struct Tick {
    core::Pose2 from;
    core::Pose2 to;
    double path_length_m = 0.0;  ///< that the wheels made
    double turn_rad = 0.0;       ///< that the wheels made
    bool backwards = false;
    double duration_s = 0.0;
    double way_share = 1.0;         ///< of the wheels' way that the robot truly went
    double slipped_turn_rad = 0.0;  ///< of the wheels' turn on the spot, before the way, none
    double slipped_bend_rad = 0.0;  ///< of their turn along the way
  };

  /// `drift` is what it counts wrongly, `told` what its covariance goes by: that, and how the
  /// wheels slip.
  DeadReckoning(const core::Pose2& start, const MotionErrors& drift, const MotionErrors& told);
  DeadReckoning(const core::Pose2& start, const MotionErrors& drift)
      : DeadReckoning(start, drift, drift) {}

  void count(const Tick& tick, const core::Random& random);

  /// Of pose_odom_robot.
  domain::PoseCovariance covariance() const;

  const State& state() const { return state_; }
  State& state() { return state_; }

 private:
  void propagate(const core::Vec2& way_odom, double counted_m, double counted_rad);

  MotionErrors drift_;
  MotionErrors told_;
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, DeadReckoning::PoseError& e) {
  visit(e.x_m, e.y_m, e.heading_rad);
}

template <typename Visitor>
void visit_fields(Visitor& visit, DeadReckoning::State& s) {
  visit(s.pose_odom_robot, s.travel_m, s.speed_mps, s.turn_rate_radps, s.noise, s.systematic);
}

}  // namespace clew::drive

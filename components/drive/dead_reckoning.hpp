// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/geometry.hpp"
#include "core/random.hpp"

namespace clew::drive {

struct DriftParameters {
  double m_per_m = 0.0;
  double rad_per_rad = 0.0;
  double rad_per_m = 0.0;
  double m_per_sqrt_m = 0.0;
  double rad_per_sqrt_rad = 0.0;
  double rad_per_sqrt_m = 0.0;

  /// Whether there is any error at all.
  bool any() const {
    return m_per_m != 0.0 || rad_per_rad != 0.0 || rad_per_m != 0.0 || m_per_sqrt_m != 0.0 ||
           rad_per_sqrt_rad != 0.0 || rad_per_sqrt_m != 0.0;
  }
};

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
/// Of a tick in which the robot truly went s metres and turned by theta, it counts
///
///     s'     = s (1 + m_per_m) + m_per_sqrt_m sqrt(s) N_0
///     theta' = theta (1 + rad_per_rad) + rad_per_m s + rad_per_sqrt_m sqrt(s) N_1
///              + rad_per_sqrt_rad sqrt(|theta|) N_2
///
/// with N_i standard normal. The variances grow in proportion to the way, so the drift of a path
/// does not depend on how it is cut into ticks. Without errors belief is the truth, to the bit.
class DeadReckoning {
 public:
  struct State {
    core::Pose2 pose_odom_robot;
    double travel_m = 0.0;
    double speed_mps = 0.0;
    double turn_rate_radps = 0.0;
  };
  /// What truly happened in a tick, in the world's frame.
  struct Tick {
    core::Pose2 from;
    core::Pose2 to;
    double path_length_m = 0.0;
    double turn_rad = 0.0;
    bool backwards = false;
    double duration_s = 0.0;
  };

  DeadReckoning(const core::Pose2& start, const DriftParameters& drift);

  void count(const Tick& tick, const core::Random& random);

  const State& state() const { return state_; }
  State& state() { return state_; }

 private:
  DriftParameters drift_;
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, DeadReckoning::State& s) {
  visit(s.pose_odom_robot, s.travel_m, s.speed_mps, s.turn_rate_radps);
}

}  // namespace clew::drive

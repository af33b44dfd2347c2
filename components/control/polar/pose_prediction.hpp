// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/bounded_vector.hpp"
#include "core/geometry.hpp"

namespace clew::control {

/// Where a pose is after a way of step_m along an arc on which the heading turns by turn_rad.
core::Pose2 along_arc(const core::Pose2& from, double step_m, double turn_rad);

/// Where the robot will be at the end of the control cycle, if it moves on as it does: Lagoudakis &
/// Maida 1999, *Configuration Prediction*. The length of a cycle is the mean of the last five
/// differences of simulated time between steps.
class PosePrediction {
 public:
  static constexpr std::size_t kDifferences = 5;

  struct State {
    /// Of the last steps, oldest first.
    core::BoundedVector<double, kDifferences + 1> times_s;
  };

  /// tick_s: the cycle before there is a difference.
  explicit PosePrediction(double tick_s) : tick_s_(tick_s) {}

  /// A step at this time. False if the robot was steered by others since the step before, so that
  /// what was known of its surroundings is out of date, and the differences with it.
  bool observe(double sim_time_s);

  double cycle_s() const;
  core::Pose2 predict(const core::Pose2& pose, double speed_mps, double turn_rate_radps) const {
    return along_arc(pose, speed_mps * cycle_s(), turn_rate_radps * cycle_s());
  }

  State& state() { return state_; }
  const State& state() const { return state_; }

 private:
  double tick_s_;
  State state_;
};

template <typename Visitor>
void visit_fields(Visitor& visit, PosePrediction::State& s) {
  visit(s.times_s);
}

}  // namespace clew::control

// SPDX-License-Identifier: Apache-2.0
#include "control/polar/pose_prediction.hpp"

#include <algorithm>
#include <cmath>

namespace clew::control {
namespace {

/// A longer time between two steps means that control was not asked in between.
constexpr double kMostTicksBetweenSteps = 1.5;

}  // namespace

core::Pose2 along_arc(const core::Pose2& from, double step_m, double turn_rad) {
  // The chord of an arc of length s over an angle a is s sin(a / 2) / (a / 2), at a / 2.
  const double half_rad = 0.5 * turn_rad;
  const double shortening = std::fabs(half_rad) < 1e-6 ? 1.0 : core::sin(half_rad) / half_rad;
  const core::Vec2 to =
      from.position() + step_m * shortening * core::direction(from.heading_rad + half_rad);
  return {to.x(), to.y(), core::wrap_angle_rad(from.heading_rad + turn_rad)};
}

bool PosePrediction::observe(double sim_time_s) {
  auto& times_s = state_.times_s;
  const bool in_time = times_s.empty() ||
                       sim_time_s - times_s[times_s.size() - 1] <= kMostTicksBetweenSteps * tick_s_;
  if (!in_time) times_s.clear();
  if (times_s.full()) {
    std::rotate(times_s.begin(), times_s.begin() + 1, times_s.end());
    times_s.resize(times_s.size() - 1);
  }
  times_s.push_back(sim_time_s);
  return in_time;
}

double PosePrediction::cycle_s() const {
  const auto& times_s = state_.times_s;
  if (times_s.size() < 2) return tick_s_;
  return (times_s[times_s.size() - 1] - times_s[0]) / static_cast<double>(times_s.size() - 1);
}

}  // namespace clew::control

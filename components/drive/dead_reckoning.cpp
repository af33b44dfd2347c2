// SPDX-License-Identifier: Apache-2.0
#include "drive/dead_reckoning.hpp"

#include <algorithm>
#include <cmath>

#include "core/angle.hpp"

namespace clew::drive {
namespace {

using domain::PoseCovariance;
using PoseError = DeadReckoning::PoseError;

// A drift that leaves no mission; beyond it numbers of a stranger could grow without end.
constexpr double kMost = 1e9;
// What a state may have of rounding.
constexpr double kRounding_ratio = 1.0 + 1e-6;

PoseError times(double factor, const PoseError& error) {
  return {factor * error.x_m, factor * error.y_m, factor * error.heading_rad};
}

/// P + variance * e e^T.
void add(double variance, const PoseError& e, PoseCovariance& p) {
  p.x_m2 += variance * e.x_m * e.x_m;
  p.xy_m2 += variance * e.x_m * e.y_m;
  p.x_heading_m_rad += variance * e.x_m * e.heading_rad;
  p.y_m2 += variance * e.y_m * e.y_m;
  p.y_heading_m_rad += variance * e.y_m * e.heading_rad;
  p.heading_rad2 += variance * e.heading_rad * e.heading_rad;
}

/// Rounding must not leave a covariance beyond what its variances allow.
double within(double covariance, double variance_a, double variance_b) {
  const double bound = std::sqrt(variance_a) * std::sqrt(variance_b);
  return std::clamp(covariance, -bound, bound);
}

/// F P F^T over the way d: an error of the heading swings the way.
void carry(const core::Vec2& d, PoseCovariance& p) {
  const double x_heading = p.x_heading_m_rad - d.y() * p.heading_rad2;
  const double y_heading = p.y_heading_m_rad + d.x() * p.heading_rad2;
  const double xy = p.xy_m2 + d.x() * p.x_heading_m_rad - d.y() * y_heading;
  const double x = p.x_m2 - d.y() * (p.x_heading_m_rad + x_heading);
  const double y = p.y_m2 + d.x() * (p.y_heading_m_rad + y_heading);
  p.x_m2 = std::clamp(x, 0.0, kMost);
  p.y_m2 = std::clamp(y, 0.0, kMost);
  p.heading_rad2 = std::min(p.heading_rad2, kMost);
  p.xy_m2 = within(xy, p.x_m2, p.y_m2);
  p.x_heading_m_rad = within(x_heading, p.x_m2, p.heading_rad2);
  p.y_heading_m_rad = within(y_heading, p.y_m2, p.heading_rad2);
}

/// Keeps variances to kMost, and covariances to what these allow then.
void bound(PoseCovariance& p) {
  if (p.x_m2 <= kMost && p.y_m2 <= kMost && p.heading_rad2 <= kMost) return;
  p.x_m2 = std::min(p.x_m2, kMost);
  p.y_m2 = std::min(p.y_m2, kMost);
  p.heading_rad2 = std::min(p.heading_rad2, kMost);
  p.xy_m2 = within(p.xy_m2, p.x_m2, p.y_m2);
  p.x_heading_m_rad = within(p.x_heading_m_rad, p.x_m2, p.heading_rad2);
  p.y_heading_m_rad = within(p.y_heading_m_rad, p.y_m2, p.heading_rad2);
}

}  // namespace

DeadReckoning::DeadReckoning(const core::Pose2& start, const MotionErrors& drift,
                             const MotionErrors& told)
    : drift_(drift), told_(told) {
  state_.pose_odom_robot = start;
}

void DeadReckoning::count(const Tick& tick, const core::Random& random) {
  const double s_m = tick.path_length_m;
  double counted_m = s_m * (1.0 + drift_.m_per_m);
  if (s_m > 0.0 && drift_.m_per_sqrt_m > 0.0) {
    counted_m += drift_.m_per_sqrt_m * std::sqrt(s_m) * random.normal(0);
  }
  counted_m = std::max(counted_m, 0.0);
  double error_rad = drift_.rad_per_rad * tick.turn_rad + drift_.rad_per_m * s_m;
  if (drift_.rad_per_sqrt_m > 0.0) {
    error_rad += drift_.rad_per_sqrt_m * std::sqrt(s_m) * random.normal(1);
  }
  if (drift_.rad_per_sqrt_rad > 0.0) {
    error_rad += drift_.rad_per_sqrt_rad * std::sqrt(std::fabs(tick.turn_rad)) * random.normal(2);
  }

  // The true way of the tick as the robot's frame saw it, turned into the believed frame. A turn on
  // the spot comes before the way; half of all other error of heading has come up on its middle.
  core::Pose2& pose = state_.pose_odom_robot;
  const core::Vec2 way = tick.to.position() - tick.from.position();
  const core::Vec2 frame =
      core::direction(pose.heading_rad - tick.from.heading_rad + tick.slipped_turn_rad +
                      0.5 * (error_rad + tick.slipped_bend_rad));
  const double scale = s_m > 0.0 ? counted_m / (s_m * tick.way_share) : 0.0;
  const core::Vec2 way_odom(scale * (frame.x() * way.x() - frame.y() * way.y()),
                            scale * (frame.y() * way.x() + frame.x() * way.y()));
  pose.x_m += way_odom.x();
  pose.y_m += way_odom.y();
  pose.heading_rad = core::wrap_angle_rad(pose.heading_rad + tick.turn_rad + error_rad);

  state_.travel_m += counted_m;
  state_.speed_mps = (tick.backwards ? -counted_m : counted_m) / tick.duration_s;
  state_.turn_rate_radps = (tick.turn_rad + error_rad) / tick.duration_s;
  propagate(way_odom, counted_m, tick.turn_rad + error_rad);
}

/// Takes covariance and systematic errors over a tick's way.
void DeadReckoning::propagate(const core::Vec2& way_odom, double counted_m, double counted_rad) {
  const PoseError along{counted_m > 0.0 ? way_odom.x() / counted_m : 0.0,
                        counted_m > 0.0 ? way_odom.y() / counted_m : 0.0, 0.0};
  const PoseError turned{-0.5 * way_odom.y(), 0.5 * way_odom.x(), 1.0};
  domain::PoseCovariance& p = state_.noise;
  carry(way_odom, p);
  add(told_.m_per_sqrt_m * told_.m_per_sqrt_m * counted_m, along, p);
  add(told_.rad_per_sqrt_m * told_.rad_per_sqrt_m * counted_m +
          told_.rad_per_sqrt_rad * told_.rad_per_sqrt_rad * std::fabs(counted_rad),
      turned, p);
  bound(p);
  const std::array<PoseError, kSystematic> of_tick = {
      times(told_.m_per_m * counted_m, along), times(told_.rad_per_rad * counted_rad, turned),
      times(told_.rad_per_m * counted_m, turned)};
  for (std::size_t i = 0; i < kSystematic; ++i) {
    PoseError& b = state_.systematic[i];
    b.x_m += of_tick[i].x_m - way_odom.y() * b.heading_rad;
    b.y_m += of_tick[i].y_m + way_odom.x() * b.heading_rad;
    b.heading_rad += of_tick[i].heading_rad;
    for (double* part : {&b.x_m, &b.y_m, &b.heading_rad}) {
      *part = std::clamp(*part, -kMost, kMost);
    }
  }
}

domain::PoseCovariance DeadReckoning::covariance() const {
  domain::PoseCovariance sum = state_.noise;
  for (const PoseError& error : state_.systematic) add(1.0, error, sum);
  return sum;
}

bool DeadReckoning::State::is_sound() const {
  const auto is_variance = [](double value) { return value >= 0.0 && value <= kMost; };
  const auto fits = [](double covariance, double variance_a, double variance_b) {
    return within(covariance, variance_a * kRounding_ratio, variance_b * kRounding_ratio) ==
           covariance;
  };
  bool sound = is_variance(noise.x_m2) && is_variance(noise.y_m2) &&
               is_variance(noise.heading_rad2) && fits(noise.xy_m2, noise.x_m2, noise.y_m2) &&
               fits(noise.x_heading_m_rad, noise.x_m2, noise.heading_rad2) &&
               fits(noise.y_heading_m_rad, noise.y_m2, noise.heading_rad2);
  for (const PoseError& error : systematic) {
    sound = sound && std::fabs(error.x_m) <= kMost && std::fabs(error.y_m) <= kMost &&
            std::fabs(error.heading_rad) <= kMost;
  }
  return sound;
}

}  // namespace clew::drive

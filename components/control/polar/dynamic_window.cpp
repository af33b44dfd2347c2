// SPDX-License-Identifier: Apache-2.0
#include "control/polar/dynamic_window.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "control/polar/pose_prediction.hpp"

namespace clew::control {
namespace {

constexpr double kFar = std::numeric_limits<double>::max();
/// What rounding may take from a distance that is kept.
constexpr double kRounding_m2 = 1e-9;

/// Value i of `count`, evenly from `least` to `most`.
double spread(double least, double most, std::size_t i, std::size_t count) {
  return least + (most - least) * static_cast<double>(i) / static_cast<double>(count - 1);
}

}  // namespace

DynamicWindow::DynamicWindow(const DynamicWindowParameters& parameters,
                             const domain::MotionLimits& drive, double radius_m)
    : parameters_(parameters), keep_m_(radius_m + parameters.stop_margin_m) {
  limits_.speed_mps = std::min(drive.speed_mps, parameters.max_speed_mps);
  limits_.turn_rate_radps = std::min(drive.turn_rate_radps, parameters.max_turn_rate_radps);
  limits_.acceleration_mps2 = std::min(drive.acceleration_mps2, parameters.max_acceleration_mps2);
  limits_.turn_acceleration_radps2 =
      std::min(drive.turn_acceleration_radps2, parameters.max_turn_acceleration_radps2);
  const auto count = static_cast<std::size_t>(parameters.speeds * parameters.turn_rates) + 1;
  cells_.resize(count);
  stops_.resize(count);
  for (auto* samples : {&x_m_, &y_m_, &nearest2_m2_, &excess_m2_}) {
    samples->resize(count * kSamples);
  }
}

double DynamicWindow::braking_s(double speed_mps, double turn_rate_radps) const {
  return std::max(speed_mps / limits_.acceleration_mps2,
                  std::fabs(turn_rate_radps) / limits_.turn_acceleration_radps2);
}

double DynamicWindow::reach_m(double cycle_s) const {
  const double way_m =
      limits_.speed_mps * (cycle_s + 0.5 * braking_s(limits_.speed_mps, limits_.turn_rate_radps));
  return way_m + keep_m_ + parameters_.density_reach_m;
}

const WindowCell& DynamicWindow::choose(double speed_mps, double turn_rate_radps, double cycle_s,
                                        const Goal& goal, const std::vector<core::Vec2>& seen,
                                        const std::vector<core::Vec2>& remembered) {
  lay_out(std::max(0.0, speed_mps), turn_rate_radps, cycle_s);
  for (std::size_t i = 0; i < cells_.size(); ++i) follow(i, cycle_s);
  std::fill(nearest2_m2_.begin(), nearest2_m2_.end(), kFar);
  std::fill(excess_m2_.begin(), excess_m2_.end(), kFar);
  box_ways();
  for (const core::Vec2& place : seen) {
    if (can_matter(place)) measure_seen(place);
  }
  for (const core::Vec2& place : remembered) {
    if (can_matter(place)) measure_remembered(place);
  }
  chosen_ = cells_.size() - 1;
  double least_m = kFar;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    WindowCell& cell = cells_[i];
    const auto first = excess_m2_.begin() + static_cast<std::ptrdiff_t>(i * kSamples);
    cell.stops_in_time = *std::min_element(first, first + kSamples) >= 0.0;
    const double turn_rad = core::wrap_angle_rad(stops_[i].heading_rad - goal.heading_rad);
    cell.objective_m = core::length(stops_[i].position() - goal.place) +
                       parameters_.heading_weight_m_per_rad * std::fabs(turn_rad) +
                       parameters_.density_weight_m * density(i);
    if (cell.stops_in_time && cell.objective_m < least_m) {
      least_m = cell.objective_m;
      chosen_ = i;
    }
  }
  return cells_[chosen_];
}

/// The pairs that a cycle can lead to, and braking, which keeps the curvature.
void DynamicWindow::lay_out(double speed_mps, double turn_rate_radps, double cycle_s) {
  const double change_mps = limits_.acceleration_mps2 * cycle_s;
  const double change_radps = limits_.turn_acceleration_radps2 * cycle_s;
  const double most_mps = limits_.speed_mps;
  const double most_radps = limits_.turn_rate_radps;
  const double slowest_mps = std::clamp(speed_mps - change_mps, 0.0, most_mps);
  const double fastest_mps = std::clamp(speed_mps + change_mps, 0.0, most_mps);
  const double rightmost_radps =
      std::clamp(turn_rate_radps - change_radps, -most_radps, most_radps);
  const double leftmost_radps = std::clamp(turn_rate_radps + change_radps, -most_radps, most_radps);
  const auto speeds = static_cast<std::size_t>(parameters_.speeds);
  for (std::size_t i = 0; i < speeds; ++i) {
    for (std::size_t j = 0; j < turn_rates(); ++j) {
      WindowCell& cell = cells_[i * turn_rates() + j];
      cell.speed_mps = spread(slowest_mps, fastest_mps, i, speeds);
      cell.turn_rate_radps = spread(rightmost_radps, leftmost_radps, j, turn_rates());
    }
  }
  const double needed_s = braking_s(speed_mps, turn_rate_radps);
  const double left = needed_s > cycle_s ? 1.0 - cycle_s / needed_s : 0.0;
  cells_.back().speed_mps = left * speed_mps;
  cells_.back().turn_rate_radps = left * turn_rate_radps;
}

/// Samples of a cell's way at equal distances, the stop last.
void DynamicWindow::follow(std::size_t cell, double cycle_s) {
  const double speed_mps = cells_[cell].speed_mps;
  const double turn_rate_radps = cells_[cell].turn_rate_radps;
  const double lasts_s = this->lasts_s(cells_[cell], cycle_s);
  const double share = 1.0 / static_cast<double>(kSamples);
  const core::Pose2 first =
      along_arc({}, share * speed_mps * lasts_s, share * turn_rate_radps * lasts_s);
  // Each part is the first one, turned by the heading at its beginning.
  const core::Vec2 turned = core::direction(first.heading_rad);
  core::Vec2 at = core::Vec2::Zero();
  core::Vec2 ahead(1.0, 0.0);
  for (std::size_t i = cell * kSamples; i < (cell + 1) * kSamples; ++i) {
    at += core::Vec2(ahead.x() * first.x_m - ahead.y() * first.y_m,
                     ahead.y() * first.x_m + ahead.x() * first.y_m);
    ahead = core::Vec2(ahead.x() * turned.x() - ahead.y() * turned.y(),
                       ahead.y() * turned.x() + ahead.x() * turned.y());
    x_m_[i] = at.x();
    y_m_[i] = at.y();
  }
  stops_[cell] = {at.x(), at.y(), core::wrap_angle_rad(turn_rate_radps * lasts_s)};
}

void DynamicWindow::box_ways() {
  const auto [left, right] = std::minmax_element(x_m_.begin(), x_m_.end());
  const auto [bottom, top] = std::minmax_element(y_m_.begin(), y_m_.end());
  const core::Vec2 reach(keep_m_ + parameters_.density_reach_m,
                         keep_m_ + parameters_.density_reach_m);
  least_ = core::Vec2(*left, *bottom) - reach;
  most_ = core::Vec2(*right, *top) + reach;
}

/// Whether a point may bar a way, or count in its density: most are farther off than that.
bool DynamicWindow::can_matter(const core::Vec2& place) const {
  return place.x() >= least_.x() && place.x() <= most_.x() && place.y() >= least_.y() &&
         place.y() <= most_.y();
}

/// What a point that is seen means for all samples.
void DynamicWindow::measure_seen(const core::Vec2& place) {
  const double now2_m2 = place.x() * place.x() + place.y() * place.y();
  const double keep2_m2 = std::min(keep_m_ * keep_m_, now2_m2) - kRounding_m2;
  for (std::size_t i = 0; i < x_m_.size(); i += kLanes) {
    const Lanes distance2 = distance2_m2(i, place);
    const Lanes over = distance2 - keep2_m2;
    const Lanes nearest = load_lanes(&nearest2_m2_[i]);
    const Lanes excess = load_lanes(&excess_m2_[i]);
    store_lanes(distance2 < nearest ? distance2 : nearest, &nearest2_m2_[i]);
    store_lanes(over < excess ? over : excess, &excess_m2_[i]);
  }
}

/// What one that is remembered means for them: it counts in the density, and keeps nothing off.
void DynamicWindow::measure_remembered(const core::Vec2& place) {
  for (std::size_t i = 0; i < x_m_.size(); i += kLanes) {
    const Lanes distance2 = distance2_m2(i, place);
    const Lanes nearest = load_lanes(&nearest2_m2_[i]);
    store_lanes(distance2 < nearest ? distance2 : nearest, &nearest2_m2_[i]);
  }
}

/// Squared distances of a point from two samples.
Lanes DynamicWindow::distance2_m2(std::size_t sample, const core::Vec2& place) const {
  const Lanes dx = load_lanes(&x_m_[sample]) - place.x();
  const Lanes dy = load_lanes(&y_m_[sample]) - place.y();
  return dx * dx + dy * dy;
}

double DynamicWindow::density(std::size_t cell) const {
  double sum = 0.0;
  for (std::size_t i = cell * kSamples; i < (cell + 1) * kSamples; ++i) {
    const double away_m = std::sqrt(nearest2_m2_[i]) - keep_m_;
    sum += std::clamp(1.0 - away_m / parameters_.density_reach_m, 0.0, 1.0);
  }
  return sum / static_cast<double>(kSamples);
}

}  // namespace clew::control

// SPDX-License-Identifier: Apache-2.0
#include "scan/safe_regions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/angle.hpp"

namespace clew::scan {
namespace {

constexpr double kFree = std::numeric_limits<double>::infinity();
constexpr double kRightAngle_rad = 0.5 * core::kPi;

}  // namespace

double SafeRegion::nearest_rad(double bearing_rad) const {
  const double middle_rad = right_rad + 0.5 * width_rad;
  const double off_rad = core::wrap_angle_rad(bearing_rad - middle_rad);
  return core::wrap_angle_rad(middle_rad + std::clamp(off_rad, -0.5 * width_rad, 0.5 * width_rad));
}

void SafeRegions::update(const domain::Scan& scan) {
  if (scan.ranges_m.size() != beams_ || scan.bearing_step_rad != step_rad_ ||
      scan.beam_width_rad != width_rad_) {
    adopt_shape(scan);
  }
  const bool leftward = step_rad_ >= 0.0;
  first_rad_ = leftward || beams_ == 0 ? scan.bearing_first_rad : scan.bearing_rad(beams_ - 1);
  std::size_t reach = 0;
  std::size_t top = 0;
  for (std::size_t beam = 0, direction = 0; beam < beams_; ++beam, direction = next(direction)) {
    const double range_m = scan.ranges_m[leftward ? beam : beams_ - 1 - beam];
    if (range_m >= scan.range_max_m) continue;
    const double distance_m = range_m + radius_m_;
    reach = reach_from(reach, distance_m);
    top = std::max(top, lower(direction, reach, std::max(0.0, distance_m - rho_m_)));
  }
  for (std::size_t l = top; l > 0; --l) hand_down(l);
  for (std::size_t i = 0; i < size(); ++i) {
    free_m_[i] = std::min(levels_[0][i], scan.range_max_m);
    levels_[0][i] = kFree;
  }
}

/// Bounds the next level below by what a level holds, which is free again.
void SafeRegions::hand_down(std::size_t level) {
  const std::size_t half = std::size_t{1} << (level - 1);
  const std::size_t wrapped_half = size() - half;
  const double* const bounds_m = levels_[level].data();
  double* const below_m = levels_[level - 1].data();
  for (std::size_t i = 0; i < half; ++i) {
    below_m[i] = std::min(below_m[i], std::min(bounds_m[i], bounds_m[i + wrapped_half]));
  }
  for (std::size_t i = half; i < size(); ++i) {
    below_m[i] = std::min(below_m[i], std::min(bounds_m[i], bounds_m[i - half]));
  }
  std::fill(levels_[level].begin(), levels_[level].end(), kFree);
}

/// Tables for scans of this shape.
void SafeRegions::adopt_shape(const domain::Scan& scan) {
  beams_ = scan.ranges_m.size();
  step_rad_ = scan.bearing_step_rad;
  width_rad_ = scan.beam_width_rad;
  const double step_rad = std::fabs(step_rad_);
  std::size_t directions = beams_;
  full_circle_ = false;
  if (beams_ > 1 && step_rad > 0.0) {
    // The last beam of a circle may repeat the first one.
    const auto around = static_cast<std::size_t>(std::floor(2.0 * core::kPi / step_rad + 0.5));
    full_circle_ = around > 0 && beams_ >= around;
    if (full_circle_) directions = around;
  }
  free_m_.assign(directions, 0.0);
  sines_.clear();
  for (std::size_t k = 1; k < directions; ++k) {
    const double angle_rad = std::max(0.0, static_cast<double>(k) * step_rad - 0.5 * width_rad_);
    if (angle_rad > kRightAngle_rad) break;
    sines_.push_back(core::sin(angle_rad));
  }
  levels_of_.assign(directions + 1, 0);
  for (std::size_t n = 2; n <= directions; ++n) levels_of_[n] = levels_of_[n / 2] + 1;
  levels_.assign(directions == 0 ? 0 : levels_of_[directions] + 1,
                 std::vector<double>(directions, kFree));
}

/// How many directions on each side a return at that distance keeps the robot out of. Sought in
/// doubling steps from `guess`, that of the beam beside, since neighbours lie at like distances.
std::size_t SafeRegions::reach_from(std::size_t guess, double distance_m) const {
  const auto within = [&](double sine) { return distance_m * sine < rho_m_; };
  std::size_t low = guess;   // all before are within
  std::size_t high = guess;  // none from here on is
  for (std::size_t step = 1; low > 0 && !within(sines_[low - 1]); step *= 2) {
    high = low - 1;
    low -= std::min(low, step);
  }
  for (std::size_t step = 1; high < sines_.size() && within(sines_[high]); step *= 2) {
    low = high + 1;
    high = std::min(sines_.size(), high + step);
  }
  const auto begin = sines_.begin();
  const auto end = std::partition_point(begin + static_cast<std::ptrdiff_t>(low),
                                        begin + static_cast<std::ptrdiff_t>(high), within);
  return static_cast<std::size_t>(end - begin);
}

/// Bounds the directions within `reach` of one, and tells at which level. A run of any length is
/// two runs, which may overlap, of a power of two.
std::size_t SafeRegions::lower(std::size_t direction, std::size_t reach, double free_m) {
  const std::size_t n = size();
  std::size_t first = direction >= reach ? direction - reach : 0;
  std::size_t count = std::min(direction + reach, n - 1) - first + 1;
  if (full_circle_) {
    first = direction >= reach ? direction - reach : direction + n - std::min(reach, n);
    count = std::min(2 * reach + 1, n);
  }
  const std::size_t level = levels_of_[count];
  first = wrapped(first);
  const std::size_t second = wrapped(first + count - (std::size_t{1} << level));
  std::vector<double>& bounds_m = levels_[level];
  bounds_m[first] = std::min(bounds_m[first], free_m);
  bounds_m[second] = std::min(bounds_m[second], free_m);
  return level;
}

double SafeRegions::bearing_rad(std::size_t i) const {
  return core::wrap_angle_rad(first_rad_ + static_cast<double>(i) * std::fabs(step_rad_));
}

SafeRegion SafeRegions::region(std::size_t first, std::size_t count) const {
  SafeRegion found{bearing_rad(wrapped(first)),
                   static_cast<double>(count - 1) * std::fabs(step_rad_), 0.0};
  for (std::size_t k = 0; k < count; ++k) {
    found.depth_m = std::max(found.depth_m, free_m_[wrapped(first + k)]);
  }
  return found;
}

void SafeRegions::find(double depth_m, std::vector<SafeRegion>& regions) const {
  regions.clear();
  const auto open = [&](std::size_t i) { return free_m_[i] >= depth_m; };
  // On a circle the walk begins behind a direction that is not free, so that no run is cut in two.
  std::size_t begin = 0;
  if (full_circle_) {
    while (begin < size() && open(begin)) ++begin;
    if (begin == size()) begin = 0;
  }
  for (std::size_t k = 0; k < size();) {
    std::size_t count = 0;
    while (k + count < size() && open(wrapped(begin + k + count))) ++count;
    if (count > 0) regions.push_back(region(begin + k, count));
    k += count + 1;
  }
}

}  // namespace clew::scan

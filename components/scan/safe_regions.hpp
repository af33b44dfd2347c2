// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "domain/messages.hpp"

namespace clew::scan {

/// At how many depths safe regions are looked for, one after the other: the one that is asked for,
/// half of it, and a quarter.
inline constexpr int kSafeDepths = 3;

/// Neighbouring directions in which the robot may go. Bearings from the heading.
struct SafeRegion {
  double right_rad = 0.0;  ///< its rightmost direction, in (-pi, pi]
  double width_rad = 0.0;  ///< to its leftmost one, counter-clockwise; 0 for a single direction
  double depth_m = 0.0;    ///< how far the robot may go, in its deepest direction

  /// The direction inside that is nearest to `bearing_rad`.
  double nearest_rad(double bearing_rad) const;
};

/// The safe regions of Nakhaeinia et al. 2015, section II.A: gaps between returns that are wide
/// enough for the robot. Shared by controllers and detectors.
///
/// A return at distance d from the robot's centre keeps the disc of radius rho = radius + clearance
/// out of all directions within
///
///     w / 2 + asin(rho / d)        (rho / d <= 1, else a right angle)
///
/// of its own, beyond d - rho; w is the beam's width, since the return may lie anywhere on its arc.
/// This is the enlargement of Ulrich & Borenstein 1998 (VFH+, eqs 3 and 4). A direction is free as
/// far as the nearest return lets it be, or as far as the scan sees, and a safe region is a run of
/// directions that are free for the depth that is asked for: a gap is as wide as the enlarged
/// returns leave it.
///
/// *Deviation:* the paper tells gaps by the distance between neighbouring returns. That distance is
/// no width where the returns lie at different depths, or where beams are broad.
///
/// Directions are those of the beams, counter-clockwise: 0 is the rightmost one, and on a full
/// circle the last one is the first one's neighbour. One update costs n log n for n beams.
class SafeRegions {
 public:
  /// `clearance_m` is room beside the body.
  SafeRegions(double radius_m, double clearance_m)
      : radius_m_(radius_m), rho_m_(radius_m + clearance_m) {}

  /// Takes a scan; allocates only if its shape is another than the last one's.
  void update(const domain::Scan& scan);

  /// Number of directions: 0 before the first scan.
  std::size_t size() const { return free_m_.size(); }
  /// Direction i, in (-pi, pi].
  double bearing_rad(std::size_t i) const;
  /// How far the robot may go straight in direction i, at most as far as the scan sees.
  double free_m(std::size_t i) const { return free_m_[i]; }
  /// Whether the directions close a circle.
  bool full_circle() const { return full_circle_; }

  /// Fills `regions` with the runs of directions that are free for `depth_m`, from right to left;
  /// one that crosses straight behind on a full circle comes last.
  void find(double depth_m, std::vector<SafeRegion>& regions) const;

 private:
  void adopt_shape(const domain::Scan& scan);
  std::size_t wrapped(std::size_t i) const { return i < size() ? i : i - size(); }
  std::size_t next(std::size_t direction) const { return wrapped(direction + 1); }
  std::size_t reach_from(std::size_t guess, double distance_m) const;
  std::size_t lower(std::size_t direction, std::size_t reach, double free_m);
  void hand_down(std::size_t level);
  SafeRegion region(std::size_t first, std::size_t count) const;

  double radius_m_;
  double rho_m_;

  // The shape of the scans.
  std::size_t beams_ = 0;
  double step_rad_ = 0.0;  ///< as the scan gives it
  double width_rad_ = 0.0;
  double first_rad_ = 0.0;
  bool full_circle_ = false;
  std::vector<double> sines_;  ///< of the angle between a beam's edge and the k-th direction beside
  std::vector<std::size_t> levels_of_;  ///< floor(log2(n)) for n = 0..size; 0 for 0

  // levels_[l][i]: bound on directions i .. i + 2^l - 1, which is handed down level by level; all
  // free between updates.
  std::vector<std::vector<double>> levels_;
  std::vector<double> free_m_;
};

}  // namespace clew::scan

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "domain/inside.hpp"
#include "domain/messages.hpp"
#include "recover/escapes/following/side.hpp"
#include "recover/escapes/following/wall_rules.hpp"

namespace clew::recover {

/// Keeps a wall on one side at a set distance, rounds outer and inner corners, goes round the end
/// of a thin wall, and passes over slits too narrow to matter: the second fuzzy rule base of
/// Krishna & Kalra 2000, section 4.3, which the paper leaves out. It has no memory.
///
/// Sugeno rules on two readings, u_s of the outermost beam on the wall's side and u_f, the least of
/// the middle three; the motion is the mean of the rules' motions, weighted with the degrees b of
/// *blocked* (u_f) and (1 - b) c, (1 - b) g, (1 - b) f of *close*, *good*, *far* (u_s), triangles
/// that add up to 1:
///
///     blocked: turn away, slowly     close: turn away     good: straight on     far: turn toward
///
/// A wall that ends is far: the turn toward it leads round the end.
class WallFollower {
 public:
  static constexpr std::size_t kBeams = 7;

  explicit WallFollower(const WallRules& rules) : rules_(rules) {}

  /// The motion that keeps the wall on `side`.
  domain::Motion follow(const domain::Scan& scan, Side side) const;

  /// Tells the degrees that made that motion.
  void tell(const domain::Scan& scan, Side side, domain::Inside& inside) const;
  /// Whether there is no wall on that side: the obstacle has ended or turned away.
  bool at_break(const domain::Scan& scan, Side side) const;

  /// Whether any reading is near enough to be an obstacle to follow.
  bool sees_obstacle(const domain::Scan& scan) const;

 private:
  WallRules rules_;
};

}  // namespace clew::recover

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/resources.hpp"
#include "core/result.hpp"

namespace clew::recover {

/// The constants of the rule base for following an obstacle, as its file gives them. Readings as
/// shares of the range; turns in radians, toward the wall positive.
struct WallRules {
  double blocked_full_ratio = 0.0;  ///< the way ahead is blocked up to this reading
  double blocked_none_ratio = 0.0;  ///< and is not from this one on
  double close_ratio = 0.0;         ///< the wall is too close
  double good_ratio = 0.0;          ///< as it should be
  double far_ratio = 0.0;           ///< too far
  double break_ratio = 0.0;         ///< there is no wall beyond this reading
  double blocked_turn_rad = 0.0;
  double close_turn_rad = 0.0;
  double far_turn_rad = 0.0;
  double blocked_step_m = 0.0;
  double free_step_m = 0.0;

  /// Reads a rule base file. Refused: another format, keys that are unknown or missing, numbers out
  /// of range, ratios that do not rise.
  static core::Result<WallRules> parse(const core::Resource& resource);

  /// The same rules at `share` of all distances and steps: closer to the wall, and through narrower
  /// gaps, but slower.
  WallRules scaled(double share) const;
};

}  // namespace clew::recover

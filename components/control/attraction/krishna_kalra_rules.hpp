// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "core/resources.hpp"
#include "core/result.hpp"

namespace clew::control {

/// The constants of Krishna & Kalra 2000, section 2.1, as its rule base file gives them. Turns in
/// radians, clockwise positive as in the paper.
struct KrishnaKalraRules {
  static constexpr std::size_t kSensors = 7;

  double near_full_ratio = 0.0;  ///< eq. 4: near is 1 up to this share of the range
  double near_none_ratio = 0.0;  ///< eq. 4: near is 0 from this share on
  double target_turn_rad = 0.0;  ///< eq. 3: c_r = -c_l
  std::array<double, kSensors> near_turns_rad{};  ///< eq. 6: n_i, leftmost first
  std::array<double, kSensors> far_turns_rad{};   ///< eq. 6: f_i
  double target_near_step_m = 0.0;                ///< eq. 9: s_1
  double target_far_step_m = 0.0;                 ///< eq. 9: s_2
  double obstacle_near_step_m = 0.0;              ///< eq. 10: s_n
  double obstacle_far_step_m = 0.0;               ///< eq. 10: s_f

  /// Reads a rule base file. Refused: another format, keys that are unknown or missing, numbers out
  /// of range, a near band that is empty.
  static core::Result<KrishnaKalraRules> parse(const core::Resource& resource);
};

}  // namespace clew::control

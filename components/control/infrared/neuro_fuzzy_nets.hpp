// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "control/infrared/four_infrareds.hpp"
#include "control/infrared/gaussian_net.hpp"
#include "control/infrared/wheel_speeds.hpp"
#include "core/parameters.hpp"
#include "core/resources.hpp"
#include "core/result.hpp"

namespace clew::control {

/// The four networks of Wang, Yang & Meng, figure 5. Those of Table I look ahead and back (I_1,
/// I_2), those of Table II left and right (I_3, I_4); a wheel's speed is the sum of its two,
///
///     V_L = V_L1 + V_L2,   V_R = V_R1 + V_R2.
struct NeuroFuzzyNets {
  static constexpr std::size_t kSets = 4;  ///< too close, close, far, too far
  static constexpr std::size_t kCount = 4;
  using Net = GaussianNet<kSets>;
  enum Place : std::size_t { kLeft1, kRight1, kLeft2, kRight2 };

  /// What a set's parameters may be. Widths of 7 keep memberships of all 8-bit readings from
  /// vanishing, whatever the centres.
  static constexpr core::Range kCentres = {0.0, 255.0};
  static constexpr core::Range kWidths = {7.0, 255.0};
  static constexpr core::Range kOutputs_mps = {-2.0, 2.0};

  std::array<Net, kCount> nets{};  ///< by Place

  WheelSpeeds speeds(const InfraredReadings& readings) const {
    const auto ahead_back = [&](Place place) {
      return nets[place].infer(readings[kAhead], readings[kBack]);
    };
    const auto left_right = [&](Place place) {
      return nets[place].infer(readings[kLeft], readings[kRight]);
    };
    return {ahead_back(kLeft1) + left_right(kLeft2), ahead_back(kRight1) + left_right(kRight2)};
  }

  /// Reads either kind of rule base file: the two rule tables in words (clew-neuro-fuzzy-rules/1),
  /// or the parameters that training gave (clew-neuro-fuzzy-trained/1). Refused: another format,
  /// keys that are unknown or missing, words that are no speeds, numbers out of range.
  static core::Result<NeuroFuzzyNets> parse(const core::Resource& resource);

  /// The networks as the key `nets` of a trained file, five decimals each.
  std::string to_yaml() const;
  /// The networks with every parameter as the trained file tells it.
  NeuroFuzzyNets rounded() const;
};

}  // namespace clew::control

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/resources.hpp"
#include "core/result.hpp"
#include "domain/messages.hpp"

namespace clew::recover {

/// The immediate memory of Krishna & Kalra 2000, section 4.1 (IMAS): what the neurons of the map
/// make the robot do at once when they win. A table of landmark vectors and turns.
class ImmediateMemory {
 public:
  struct Action {
    std::array<double, 3> classes{};  ///< the landmark
    double turn_rad = 0.0;            ///< on the spot, counter-clockwise positive
  };

  /// Reads an action table. Refused: another format, keys that are unknown or missing, classes that
  /// are none, turns beyond 180 degrees, a landmark twice.
  static core::Result<ImmediateMemory> parse(const core::Resource& resource);

  explicit ImmediateMemory(std::vector<Action> actions) : actions_(std::move(actions)) {}

  /// The turn that the map's answer of this tick fires, if any: of the landmark nearest to the
  /// winner's weights, within half a class.
  std::optional<double> turn_rad(const domain::Landmark& landmark) const;

 private:
  std::vector<Action> actions_;
};

}  // namespace clew::recover

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "drive/drive_model.hpp"

namespace clew::drive {

/// One leg of constant velocities.
inline Legs arc_of(const Velocities& velocities, double tick_s) {
  Legs legs;
  legs.push_back({0.0, velocities.speed_mps * tick_s, tick_s, velocities.turn_rate_radps * tick_s});
  return legs;
}

}  // namespace clew::drive

// SPDX-License-Identifier: Apache-2.0
#include "world/ray_fan.hpp"

namespace clew::world {

RayFan::RayFan(double bearing_first_rad, double bearing_step_rad, std::size_t count)
    : bearing_first_rad_(bearing_first_rad), bearing_step_rad_(bearing_step_rad) {
  axes_.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    axes_.push_back(core::direction(bearing_first_rad + static_cast<double>(i) * bearing_step_rad));
  }
}

}  // namespace clew::world

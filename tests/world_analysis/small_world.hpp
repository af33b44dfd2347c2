// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "world/world.hpp"

namespace clew::world_analysis {

/// 10 m by 10 m; start and target as texts, `[3, 3, 0]` and `[7, 3]`.
inline world::World small_world(const std::string& obstacles, const std::string& start,
                                const std::string& target) {
  auto world = world::World::parse("format: clew-world/1\nname: small\nbounds: [0, 0, 10, 10]\n" +
                                       obstacles + "\nstart: " + start + "\ntarget: " + target +
                                       "\ntarget_radius: 0.2\n",
                                   "small.yaml");
  if (!world.ok()) ADD_FAILURE() << world.error().text();
  return std::move(world).value();
}

inline constexpr double kRadius_m = 0.15;

}  // namespace clew::world_analysis

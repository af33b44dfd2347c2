// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/geometry.hpp"

namespace clew::world_import {

using core::Pose2;
using core::Vec2;

/// A world on its way from somebody else's format: what a world file says, before start and target
/// are known.
struct WorldDraft {
  struct Circle {
    Vec2 centre = Vec2::Zero();
    double radius_m = 0.0;
  };

  std::string name;
  std::string about;
  Vec2 bounds_min = Vec2::Zero();
  Vec2 bounds_max = Vec2::Zero();
  std::vector<std::vector<Vec2>> polygons;
  std::vector<Circle> circles;
  std::optional<Pose2> start;
  std::optional<Vec2> target;
  double target_radius_m = 0.2;
};

/// The draft as a world file. Numbers read back as themselves. Start and target must be there.
std::string world_text(const WorldDraft& draft);

}  // namespace clew::world_import

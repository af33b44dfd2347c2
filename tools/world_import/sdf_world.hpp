// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/result.hpp"
#include "world_import/world_draft.hpp"

namespace clew::world_import {

/// Reads the obstacles of a Gazebo world (SDF), seen from above: the collision geometries of its
/// models, cylinders and spheres as circles, boxes as polygons, planes as nothing. The bounds hold
/// them. `<state>`, which repeats the poses, is passed over. Refused: meshes and other shapes, with
/// the model's name, and bodies that are tilted.
core::Result<WorldDraft> read_sdf_world(const std::string& path);

/// What BARN's worlds (Perille, Truong, Xiao & Stone 2020) leave to its programs: where the robot
/// starts and where it is to go, and how far the bounds reach.
void add_barn_mission(WorldDraft& draft);

}  // namespace clew::world_import

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/result.hpp"
#include "world_import/cell_world.hpp"

namespace clew::world_import {

/// Reads a map of ROS's map_server (nav2_map_server's map_io): the YAML file and its picture, which
/// lies where the file says, from where the file is. With o the darkness of a pixel, or with
/// `negate: 1` its brightness:
/// - `trinary`: occupied if o > occupied_thresh, free if o < free_thresh, else unknown;
/// - `scale`: the same, between the two as probable as o is far along; occupied from one half on;
///   transparent pixels are unknown;
/// - `raw`: the pixel's value is a percentage, over 100 unknown; occupied from occupied_thresh on,
///   free up to free_thresh, else unknown.
core::Result<CellMap> read_ros_map_cells(const std::string& path);

/// A picture without a file of its own: dark is occupied, from one half on.
core::Result<CellMap> read_picture_cells(const std::string& path, double cell_m);

}  // namespace clew::world_import

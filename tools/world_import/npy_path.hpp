// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/geometry.hpp"
#include "core/result.hpp"

namespace clew::world_import {

/// Reads an array of N x 2 numbers (int64, int32, float64 or float32, little-endian, C order) from
/// NumPy's format, versions 1 to 3 (numpy.org/doc/stable/reference/generated/numpy.lib.format).
core::Result<std::vector<core::Vec2>> read_npy_points(const std::string& path);

/// Places of BARN's paths: cells of 0.15 m.
std::vector<core::Vec2> barn_path_places(const std::vector<core::Vec2>& cells);

double length_m(const std::vector<core::Vec2>& path);

}  // namespace clew::world_import

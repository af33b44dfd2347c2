// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "map/neural_map.hpp"

namespace clew::map {

/// The path of steepest ascent over the landscape interpolated between the units (Lagoudakis &
/// Maida 1999: "interpolation methods to smooth out the activation landscape"), from the middle of
/// `from` to that of a target, in steps of half a cell.
///
/// *Deviation:* it is the logarithm of the activation that is interpolated: it falls almost evenly
/// with the distance, where the activation falls by a factor of three a cell. Its slope at a unit
/// is the plane that fits the active neighbours best (least squares, weights 1 / distance^2);
/// blocked ones have no say. Between units slopes are mixed by distance. Where a step would leave
/// the active cells or descend, the path goes to the middle of the next cell of the ascent instead.
///
/// False and no path if `from` is not active.
bool smooth_path(const NeuralMap& landscape, const Cell& from, std::vector<Vec2>& places);

}  // namespace clew::map

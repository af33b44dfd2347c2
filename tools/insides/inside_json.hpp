// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "domain/inside.hpp"

namespace clew::insides {

/// A group as an object. A number's key ends with its unit, as in `distance_m`. A grid is an object
/// with `columns`, `rows`, `columns_are`, `rows_are`, `values` (an array a row) and `marked` ([row,
/// column] or null). Numbers that are not finite become null.
nlohmann::ordered_json to_json(const domain::InsideGroup& group);

/// The layers of a picture: `name`, `kind` (values, blocked, points, way, goal), `places` and
/// `cells`, in the frame of odometry, to a tenth of a millimetre.
nlohmann::ordered_json to_json(const domain::Picture& picture);

}  // namespace clew::insides

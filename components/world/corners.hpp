// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "world/bvh.hpp"
#include "world/cone.hpp"
#include "world/polygon.hpp"
#include "world/shapes.hpp"

namespace clew::world {

/// A place where a segment ends on another one, seen from the side on which they enclose less than
/// 180 degrees.
struct Corner {
  Vec2 point = Vec2::Zero();
  Vec2 right = Vec2::Zero();  ///< unit vector along the segment on the right, seen from the point
  Vec2 left = Vec2::Zero();   ///< the same for the other; less than 180 degrees counter-clockwise

  /// Whether a point lies between the two segments, however far out.
  bool faces(const Vec2& p) const {
    const Vec2 from{p.x() - point.x(), p.y() - point.y()};
    return cross(right, from) > 0.0 && cross(from, left) > 0.0;
  }
};

inline Box box_of(const Corner& corner) {
  return {corner.point.x(), corner.point.y(), corner.point.x(), corner.point.y()};
}

/// The corners of a world's segments and its boundary: where one ends within a millimetre of
/// another. Corners that lie inside filled obstacles are left out.
std::vector<Corner> find_corners(const Indexed<World::Segment>& segments,
                                 const std::vector<World::Segment>& boundary,
                                 const FilledAreas& polygons,
                                 const Indexed<World::Circle>& circles);

/// Distance to the nearest corner in the cone that faces its apex, if nearer than max_distance_m.
std::optional<double> nearest_corner_m(const Indexed<Corner>& corners, const Cone& cone,
                                       double max_distance_m);

}  // namespace clew::world

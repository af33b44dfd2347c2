// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "world/shapes.hpp"

namespace clew::world {

using Polygon = std::vector<Vec2>;

/// The polygon's edges; edge i goes from point i to the next.
std::vector<World::Segment> edges_of(const Polygon& polygon);

/// Whether a point lies inside, by the even-odd rule; on an edge, either.
bool contains(const Polygon& polygon, const Vec2& point);

/// Two edges of a polygon that meet where they must not: not neighbours, or neighbours that fold
/// back onto each other. None if the polygon is simple.
std::optional<std::pair<std::size_t, std::size_t>> find_crossing(const Polygon& polygon);

/// What filled polygons cover, by the even-odd rule.
class FilledAreas {
 public:
  FilledAreas() = default;
  explicit FilledAreas(const std::vector<Polygon>& polygons);

  /// Whether a point lies inside a polygon; on an edge, either.
  bool contains(const Vec2& point) const;

 private:
  Bvh tree_;
  std::vector<Indexed<World::Segment>> areas_;  // edges of each, in the tree's order
};

}  // namespace clew::world

// SPDX-License-Identifier: Apache-2.0
#include "world_analysis/clearance_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace clew::world_analysis {
namespace {

std::size_t nodes_along(double length_m) {
  return static_cast<std::size_t>(std::floor(length_m / kSpacing_m)) + 1;
}

std::size_t index_along(double offset_m, std::size_t count) {
  const double index = std::floor(offset_m / kSpacing_m + 0.5);
  return std::min(static_cast<std::size_t>(std::max(index, 0.0)), count - 1);
}

}  // namespace

std::optional<double> settled_time_s(const world::World& world) {
  double settled_s = 0.0;
  for (const world::MovingObstacle& obstacle : world.moving()) {
    if (obstacle.loop && obstacle.path.size() > 1) return std::nullopt;
    settled_s = std::max(settled_s, obstacle.path.back().time_s);
  }
  return settled_s;
}

double lattice_nodes(const world::World& world) {
  const Vec2 size = world.bounds_max() - world.bounds_min();
  return (std::floor(size.x() / kSpacing_m) + 1.0) * (std::floor(size.y() / kSpacing_m) + 1.0);
}

bool fits_lattice(const world::World& world) { return lattice_nodes(world) <= kMostNodes; }

std::vector<Leg> legs_of(const world::World& world) {
  std::vector<Leg> legs;
  Vec2 from = world.start().position();
  for (const world::Waypoint& waypoint : world.waypoints()) {
    legs.push_back({from, waypoint.place, waypoint.radius_m});
    from = waypoint.place;
  }
  if (legs.empty()) legs.push_back({from, world.target(), world.target_radius_m()});
  return legs;
}

core::Result<double> surveyed_time_s(const world::World& world) {
  const auto settled_s = settled_time_s(world);
  if (!settled_s) return core::Error{"something moves for ever"};
  if (world.waypoints().size() > 1) {
    return core::Error{"its mission leads along way-points, and not from start to target alone"};
  }
  if (fits_lattice(world)) return *settled_s;
  return core::Error{
      fmt::format("it has {:.0f} million places {} m apart, more than the {:.0f} million that are "
                  "looked at",
                  1e-6 * lattice_nodes(world), kSpacing_m, 1e-6 * kMostNodes)};
}

ClearanceGrid::ClearanceGrid(const world::World& world, double time_s)
    : world_(&world),
      time_s_(time_s),
      columns_(nodes_along(world.bounds_max().x() - world.bounds_min().x())),
      rows_(nodes_along(world.bounds_max().y() - world.bounds_min().y())),
      clearances_m_(columns_ * rows_) {
  for (std::size_t node = 0; node < clearances_m_.size(); ++node) {
    clearances_m_[node] = world.clearance_m(position(node), kMost_m, time_s);
  }
}

Vec2 ClearanceGrid::position(std::size_t node) const {
  const Vec2& min = world_->bounds_min();
  return {min.x() + kSpacing_m * static_cast<double>(node % columns_),
          min.y() + kSpacing_m * static_cast<double>(node / columns_)};
}

std::size_t ClearanceGrid::nearest(const Vec2& position) const {
  const Vec2& min = world_->bounds_min();
  return index_along(position.y() - min.y(), rows_) * columns_ +
         index_along(position.x() - min.x(), columns_);
}

std::optional<std::size_t> ClearanceGrid::nearest_free(const Vec2& position,
                                                       double radius_m) const {
  const std::size_t middle = nearest(position);
  if (clearances_m_[middle] >= radius_m) return middle;
  std::optional<std::size_t> best;
  double best_m = std::numeric_limits<double>::infinity();
  visit_around(middle, 2, [&](std::size_t node) {
    const double distance_m = core::length(this->position(node) - position);
    if (clearances_m_[node] < radius_m || distance_m >= best_m) return;
    best = node;
    best_m = distance_m;
  });
  return best;
}

bool ClearanceGrid::is_way_free(const Vec2& from, const Vec2& to, double radius_m) const {
  return world_->clearance_m(from, radius_m, time_s_) >= radius_m &&
         !world_->sweep_disc(from, to, radius_m, time_s_, 0.0).contact;
}

bool ClearanceGrid::is_way_free(std::size_t from, std::size_t to, double radius_m) const {
  const double least_m = std::min(clearances_m_[from], clearances_m_[to]);
  if (least_m < radius_m) return false;
  const Vec2 a = position(from);
  const Vec2 b = position(to);
  const double both_m = clearances_m_[from] + clearances_m_[to];
  if (both_m - core::length(b - a) >= 2.0 * radius_m) return true;
  return is_way_free(a, b, radius_m);
}

}  // namespace clew::world_analysis

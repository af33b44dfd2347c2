// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/result.hpp"
#include "world/world.hpp"

namespace clew::world_analysis {

using core::Vec2;

/// Side of a cell: a third of the robots' usual radius.
inline constexpr double kSpacing_m = 0.05;

/// When everything that moves in a world has come to rest; none if something moves for ever. 0 in a
/// static world.
std::optional<double> settled_time_s(const world::World& world);

/// Nodes that a lattice has at most: with what is computed of them they take 3 GB and a few
/// minutes.
inline constexpr double kMostNodes = 5e7;

/// A part of a mission: from one place to within a radius of another.
struct Leg {
  Vec2 from = Vec2::Zero();
  Vec2 to = Vec2::Zero();
  double radius_m = 0.0;
};

/// The way from the start past the way-points, if there are any, to the target, in their order.
std::vector<Leg> legs_of(const world::World& world);

/// The nodes of a world's lattice, and whether that many are looked at.
double lattice_nodes(const world::World& world);
bool fits_lattice(const world::World& world);

/// The time for which the truth about a world is computed: settled_time_s(). An error says why
/// there is no such truth: something moves for ever, the mission has way-points, or the world does
/// not fit a lattice.
core::Result<double> surveyed_time_s(const world::World& world);

/// How far the nearest obstacle is from the nodes of a square lattice over a world's bounds, at one
/// time. Whatever is computed of a world beforehand starts from this. The world fits a lattice.
class ClearanceGrid {
 public:
  /// Clearances are capped here: beyond, no question that is asked of them depends on their value.
  static constexpr double kMost_m = 0.5;

  ClearanceGrid(const world::World& world, double time_s);

  const world::World& world() const { return *world_; }
  double time_s() const { return time_s_; }

  std::size_t size() const { return clearances_m_.size(); }
  std::size_t columns() const { return columns_; }
  std::size_t rows() const { return rows_; }
  double clearance_m(std::size_t node) const { return clearances_m_[node]; }
  Vec2 position(std::size_t node) const;
  /// The node nearest to a position within the bounds.
  std::size_t nearest(const Vec2& position) const;
  /// The node that stands for a disc at a position: the nearest one, if the disc has room there,
  /// else the nearest with room within two rows and columns. None: no room.
  std::optional<std::size_t> nearest_free(const Vec2& position, double radius_m) const;

  /// Calls visit(node) for the nodes around one, at most `reach` rows and columns away.
  template <typename Visit>
  void visit_around(std::size_t node, int reach, const Visit& visit) const {
    const int column = static_cast<int>(node % columns_);
    const int row = static_cast<int>(node / columns_);
    for (int dy = -reach; dy <= reach; ++dy) {
      for (int dx = -reach; dx <= reach; ++dx) {
        if (dx == 0 && dy == 0) continue;
        const auto neighbour = at(column + dx, row + dy);
        if (neighbour) visit(*neighbour);
      }
    }
  }
  /// The node `dx` columns and `dy` rows away, if there is one.
  std::optional<std::size_t> neighbour(std::size_t node, int dx, int dy) const {
    return at(static_cast<int>(node % columns_) + dx, static_cast<int>(node / columns_) + dy);
  }

  /// Whether a disc gets straight from one place to the other, obstacles standing as they do at
  /// time_s(). Exact.
  bool is_way_free(const Vec2& from, const Vec2& to, double radius_m) const;
  /// The same between two nodes. A clearance changes by no more than the distance, so that of the
  /// two nodes settles most cases.
  bool is_way_free(std::size_t from, std::size_t to, double radius_m) const;

 private:
  std::optional<std::size_t> at(int column, int row) const {
    if (column < 0 || row < 0 || column >= static_cast<int>(columns_) ||
        row >= static_cast<int>(rows_)) {
      return std::nullopt;
    }
    return static_cast<std::size_t>(row) * columns_ + static_cast<std::size_t>(column);
  }

  const world::World* world_;
  double time_s_;
  std::size_t columns_;
  std::size_t rows_;
  std::vector<double> clearances_m_;
};

}  // namespace clew::world_analysis

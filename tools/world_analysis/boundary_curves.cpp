// SPDX-License-Identifier: Apache-2.0
#include "world_analysis/boundary_curves.hpp"

#include <array>
#include <cstdint>
#include <optional>

namespace clew::world_analysis {
namespace {

constexpr std::uint32_t kNone = UINT32_MAX;

/// The cells between four nodes each, with a ring of blocked nodes around the lattice, so that
/// every curve closes. An *edge* joins two neighbours of a row or of a column; a curve crosses
/// those with one free end.
class Contours {
 public:
  Contours(const ClearanceGrid& grid, double radius_m)
      : grid_(grid),
        radius_m_(radius_m),
        columns_(grid.columns() + 2),
        rows_(grid.rows() + 2),
        next_(2 * columns_ * rows_, {kNone, kNone}) {}

  std::vector<BoundaryCurve> around(std::size_t free_node) {
    flood(free_node);
    for (std::size_t row = 0; row + 1 < rows_; ++row) {
      for (std::size_t column = 0; column + 1 < columns_; ++column) link_cell(column, row);
    }
    std::vector<BoundaryCurve> curves;
    std::vector<bool> seen(next_.size());
    for (std::uint32_t edge = 0; edge < next_.size(); ++edge) {
      if (next_[edge][0] != kNone && !seen[edge]) curves.push_back(trace(edge, seen));
    }
    return curves;
  }

 private:
  /// What the disc reaches from a node: along rows and columns, and slantwise between two blocked
  /// nodes where it fits.
  void flood(std::size_t from) {
    is_reached_.assign(grid_.size(), false);
    is_reached_[from] = true;
    std::vector<std::size_t> open = {from};
    while (!open.empty()) {
      const std::size_t node = open.back();
      open.pop_back();
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const auto next = grid_.neighbour(node, dx, dy);
          if (!next || is_reached_[*next] || !is_step(node, dx, dy)) continue;
          is_reached_[*next] = true;
          open.push_back(*next);
        }
      }
    }
  }

  bool has_room(std::optional<std::size_t> node) const {
    return node && grid_.clearance_m(*node) >= radius_m_;
  }
  bool is_step(std::size_t node, int dx, int dy) const {
    const auto next = grid_.neighbour(node, dx, dy);
    if (!has_room(next)) return false;
    if (dx == 0 || dy == 0) return true;
    // A third node with room joins two opposite ones along its row and its column.
    return !has_room(grid_.neighbour(node, dx, 0)) && !has_room(grid_.neighbour(node, 0, dy)) &&
           grid_.is_way_free(node, *next, radius_m_);
  }

  /// The lattice's node at a place of the larger one; kNone on the ring.
  std::uint32_t node_at(std::size_t column, std::size_t row) const {
    if (column == 0 || row == 0 || column + 1 == columns_ || row + 1 == rows_) return kNone;
    return static_cast<std::uint32_t>((row - 1) * grid_.columns() + column - 1);
  }
  bool is_free(std::size_t column, std::size_t row) const {
    const std::uint32_t node = node_at(column, row);
    return node != kNone && is_reached_[node];
  }
  std::uint32_t along_row(std::size_t column, std::size_t row) const {
    return static_cast<std::uint32_t>(2 * (row * columns_ + column));
  }
  std::uint32_t along_column(std::size_t column, std::size_t row) const {
    return along_row(column, row) + 1;
  }

  void link(std::uint32_t a, std::uint32_t b) {
    next_[a][next_[a][0] == kNone ? 0 : 1] = b;
    next_[b][next_[b][0] == kNone ? 0 : 1] = a;
  }

  /// Joins the crossed edges of the cell whose lower left node is this one.
  void link_cell(std::size_t column, std::size_t row) {
    // Corners and edges counter-clockwise from the lower left; edge i leads from corner i to the
    // next.
    const std::array<bool, 4> corners = {is_free(column, row), is_free(column + 1, row),
                                         is_free(column + 1, row + 1), is_free(column, row + 1)};
    const std::array<std::uint32_t, 4> edges = {
        along_row(column, row), along_column(column + 1, row), along_row(column, row + 1),
        along_column(column, row)};
    std::array<std::uint32_t, 4> crossed{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      if (corners[i] != corners[(i + 1) % 4]) crossed[count++] = edges[i];
    }
    if (count == 2) link(crossed[0], crossed[1]);
    if (count != 4) return;
    // Edges i - 1 and i meet in corner i. Each curve cuts one corner off: a blocked one if the disc
    // passes between them, else a free one.
    const std::size_t free_corner = corners[0] ? 0 : 1;
    const std::uint32_t a = free_corner == 0 ? node_at(column, row) : node_at(column + 1, row);
    const std::uint32_t b =
        free_corner == 0 ? node_at(column + 1, row + 1) : node_at(column, row + 1);
    const bool passes = grid_.is_way_free(a, b, radius_m_);
    const std::size_t cut = passes ? 1 - free_corner : free_corner;
    link(edges[(cut + 3) % 4], edges[cut]);
    link(edges[(cut + 1) % 4], edges[cut + 2]);
  }

  Vec2 position(std::size_t column, std::size_t row) const {
    return grid_.world().bounds_min() +
           kSpacing_m * Vec2(static_cast<double>(column) - 1.0, static_cast<double>(row) - 1.0);
  }

  /// Where the clearance between an edge's nodes is the disc's radius.
  Vec2 crossing(std::uint32_t edge) const {
    const std::size_t column = edge / 2 % columns_;
    const std::size_t row = edge / 2 / columns_;
    const std::size_t end_column = column + (edge % 2 == 0 ? 1 : 0);
    const std::size_t end_row = row + (edge % 2 == 0 ? 0 : 1);
    const auto above_m = [&](std::uint32_t node) {
      return (node == kNone ? 0.0 : grid_.clearance_m(node)) - radius_m_;
    };
    const double from_m = above_m(node_at(column, row));
    const double to_m = above_m(node_at(end_column, end_row));
    const Vec2 from = position(column, row);
    const Vec2 to = position(end_column, end_row);
    return from + from_m / (from_m - to_m) * (to - from);
  }

  BoundaryCurve trace(std::uint32_t first, std::vector<bool>& seen) const {
    BoundaryCurve curve;
    std::uint32_t before = kNone;
    for (std::uint32_t edge = first; !seen[edge];) {
      seen[edge] = true;
      curve.points.push_back(crossing(edge));
      const std::uint32_t next = next_[edge][0] == before ? next_[edge][1] : next_[edge][0];
      before = edge;
      edge = next;
    }
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
      const Vec2& next = curve.points[(i + 1) % curve.points.size()];
      curve.length_m += core::length(next - curve.points[i]);
    }
    return curve;
  }

  const ClearanceGrid& grid_;
  double radius_m_;
  std::size_t columns_;
  std::size_t rows_;
  std::vector<bool> is_reached_;
  std::vector<std::array<std::uint32_t, 2>> next_;  ///< of an edge: those on its curve
};

}  // namespace

std::vector<BoundaryCurve> boundary_curves(const ClearanceGrid& grid, double radius_m) {
  const auto start = grid.nearest_free(grid.world().start().position(), radius_m);
  if (!start) return {};
  return Contours(grid, radius_m).around(*start);
}

}  // namespace clew::world_analysis

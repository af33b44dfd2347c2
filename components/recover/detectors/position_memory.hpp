// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/archive.hpp"
#include "core/bounded_vector.hpp"
#include "core/geometry.hpp"
#include "recover/detectors/pose_drift.hpp"

namespace clew::recover {

/// The position memory of Pin & Bender 1996: a grid over the four quadrants of the plane, and for
/// each cell that the robot has been in, the visits to it. A cell is found by its key in constant
/// time, however many there are:
///
///     key = (X + Y) (X + Y + 1) / 2 + Y                                       (eq. 1, Cantor)
///
/// where X and Y count cells from the axes, outward in each quadrant.
///
/// *Deviations:* the paper indexes an array by the key, which grows with the square of the distance
/// from the origin; here the key is hashed into a table that grows with the cells that were
/// visited. The paper's lists of visits grow for ever; here a cell keeps the newest 8, and the
/// memory as a whole at most `capacity` cells: it forgets the older half of them when it is full.
class PositionMemory {
 public:
  static constexpr std::size_t kVisitsPerCell = 8;

  struct Visit {
    std::uint64_t tick = 0;
    core::Pose2 pose_odom;
    double travel_m = 0.0;  ///< by the wheels, since tick 0
    PoseDrift drift;        ///< of pose_odom
  };
  struct Cell {
    std::uint64_t key = 0;   ///< Cantor's, times four, plus the quadrant
    std::uint32_t next = 0;  ///< where the next visit goes, once the list is full
    core::BoundedVector<Visit, kVisitsPerCell> visits;
  };

  /// Cells are `grid_m` wide; at least 2 cells are kept.
  PositionMemory(double grid_m, std::size_t capacity);

  void add(const Visit& visit);
  void clear();

  /// The key of the cell that holds a position.
  std::uint64_t key_at(const core::Vec2& position_odom) const;

  /// Calls `look(visit)` for every visit kept in the cell of a position and in those around it, up
  /// to `cells` away on each side.
  template <typename Look>
  void around(const core::Vec2& position_odom, std::int64_t cells, Look&& look) const {
    const auto [x, y] = indices(position_odom);
    for (std::int64_t dx = -cells; dx <= cells; ++dx) {
      for (std::int64_t dy = -cells; dy <= cells; ++dy) {
        const std::uint64_t key = key_of(x + dx, y + dy);
        for (const Generation& generation : generations_) {
          const Cell* cell = generation.find(key);
          if (cell == nullptr) continue;
          for (const Visit& visit : cell->visits) look(visit);
        }
      }
    }
  }

  /// Number of cells kept.
  std::size_t size() const { return generations_[0].cells.size() + generations_[1].cells.size(); }

  void save(core::StateWriter& writer) const;
  void load(core::StateReader& reader);

 private:
  /// Cells in the order of their first visit, and a table of open addressing that finds them.
  struct Generation {
    std::vector<Cell> cells;
    std::vector<std::uint32_t> slots;  ///< index of a cell plus 1; 0 is empty

    const Cell* find(std::uint64_t key) const;
    Cell& find_or_add(std::uint64_t key);
    void clear();
    void index_all();

   private:
    std::size_t slot_of(std::uint64_t key) const;
  };

  std::array<std::int64_t, 2> indices(const core::Vec2& position_odom) const;
  static std::uint64_t key_of(std::int64_t x, std::int64_t y);

  double grid_m_;
  std::size_t half_capacity_;
  std::array<Generation, 2> generations_;  // the one that is being filled, and the one before
};

template <typename Visitor>
void visit_fields(Visitor& visit, PositionMemory::Visit& v) {
  visit(v.tick, v.pose_odom, v.travel_m, v.drift);
}
template <typename Visitor>
void visit_fields(Visitor& visit, PositionMemory::Cell& c) {
  visit(c.key, c.next, c.visits);
}

}  // namespace clew::recover

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "map/grid.hpp"
#include "map/nearest_marks.hpp"
#include "map/plain_blocks.hpp"
#include "map/seen_map.hpp"

namespace clew::map {

/// What keeps a robot's centre out of a cell, as far as is known; the first is the worst.
enum class Clearance : std::uint8_t {
  kNone,       ///< certainly inside an obstacle
  kTouching,   ///< believed to touch one
  kSuspected,  ///< touches a suspected one
  kNarrow,     ///< with less room than is comfortable
  kOpen
};

/// How dear the cells of a grid are to go through: the length of a way counts that many times.
struct Costmap {
  static constexpr float kBlocked = 0.0F;  ///< nobody can be there

  Grid grid;
  std::vector<float> cost;           ///< by Grid::index; >= 1, or kBlocked where there is no room
  std::vector<Clearance> clearance;  ///< the same
  /// Which of its builder's costs these are, from 1 on; 0: they come from elsewhere.
  std::uint64_t revision = 0;
  /// Cells that may cost something else than at the revision before, if the grid is the same. Some
  /// may be in it more than once.
  std::vector<std::size_t> changed;
  /// Whether `changed` holds if the grid has moved, too. Cells that only the new grid has cost 1 if
  /// they are not in it; before the first revision all cells cost 1.
  bool tells_moves = false;
  /// Where all cells cost 1; of costs that come from elsewhere, nowhere.
  PlainBlocks plain;
};

/// What of a robot's surroundings costs how much.
struct Inflation {
  /// A centre this near to a hit is certainly inside an obstacle, whatever the rounding of places
  /// to cells and of arcs to their middles.
  double impossible_m = 0.08;
  double touching_m = 0.15;     ///< a centre this near is believed to touch
  double comfortable_m = 0.25;  ///< from here on, room does not matter
  double touching_cost = 40.0;
  double suspected_cost = 8.0;  ///< nearer than touching_m to a suspected obstacle
  double seen_free_cost = 1.0;  ///< factor where it was seen free
  double narrow_cost = 2.0;     ///< just not touching; falls to 1 where it is comfortable
};

inline bool operator==(const Inflation& a, const Inflation& b) {
  return a.impossible_m == b.impossible_m && a.touching_m == b.touching_m &&
         a.comfortable_m == b.comfortable_m && a.touching_cost == b.touching_cost &&
         a.suspected_cost == b.suspected_cost && a.seen_free_cost == b.seen_free_cost &&
         a.narrow_cost == b.narrow_cost;
}

/// A centre this much nearer than the robot's radius is not believed to touch.
inline constexpr double kTouching_m = 0.01;

/// How near is impossible and how near touches, for a robot of `radius_m` on a map with cells of
/// `seen_cell_m` whose hits stand for `hit_spread_m` of arc. The rest as by default.
Inflation inflation_of(double radius_m, double hit_spread_m, double seen_cell_m);

/// Tells of each cell of a grid what it costs to have the robot's centre there, as far as is known:
/// unknown counts as free. Costs are repaired where what was seen has changed, and are those that
/// a new builder would compute.
class CostmapBuilder {
 public:
  /// How the costs' grid holds them. In a ring, a move of the grid takes work only for cells that
  /// come and go.
  enum class Places : std::uint8_t { kInRows, kInRing };

  /// Planning cells have twice the side of the map's.
  CostmapBuilder(const Inflation& inflation, double seen_cell_m, Places places = Places::kInRows);

  /// The costs over all that was seen within `reach_m` of `from`, and at least `margin_m` around it
  /// and around both places. The reach is less where the grid would have more than 2^24 cells.
  const Costmap& update(const SeenMap& seen, const Vec2& from, const Vec2& to, double margin_m,
                        double reach_m = std::numeric_limits<double>::infinity());
  /// Until the next update, a cell costs this, whatever was seen.
  void overrule(std::size_t index, float cost, Clearance clearance);

 private:
  Grid grid_over(const SeenMap& seen, const Vec2& from, const Vec2& to, double margin_m,
                 double reach_m) const;
  void lay(const Grid& grid);
  void charge(std::size_t index);
  void set_cost(std::size_t index, float cost);

  double cell_m_;
  Places places_;
  float seen_free_cost_;
  std::uint8_t impossible_steps_;
  std::uint8_t touching_steps_;
  std::uint8_t narrow_steps_;
  std::array<float, 256> hit_cost_{};  // by steps
  std::array<float, 256> suspected_cost_{};
  NearestMarks nearest_;
  Costmap costs_;
  std::vector<std::size_t> overruled_;
  std::vector<float> spare_costs_;
  std::vector<Clearance> spare_clearances_;
};

}  // namespace clew::map

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <vector>

#include "map/block_steps.hpp"
#include "map/bucket_queue.hpp"
#include "map/costmap.hpp"

namespace clew::map {

/// The least cost of a path to a set of goals, over blocks of two by two cells of a grid, repaired
/// where costs have changed: LPA* from the goals, with the keys of a start that moves (Koenig &
/// Likhachev 2002, "D* Lite").
///
/// A block costs the mean of those of its cells that are not blocked. A step leads to one of eight
/// neighbours if a cell of the one block touches a cell of the other and neither is blocked. As all
/// four cells of a block touch each other, blocks are connected exactly where their cells are: no
/// path over blocks means no path over cells, and the other way round.
///
/// A step costs its length times the mean of both costs, as a whole number: costs count in
/// quarters, a straight step 12 times the sum of both, a diagonal one 17 times. With whole numbers,
/// the least cost is one, whatever was repaired in which order. So distances and paths are, to the
/// bit, those of a new field.
///
/// *Deviations* from D* Lite. It stops when the start is settled; here every block is settled
/// through which a best path from the start may lead, so which of several equally good ones path()
/// takes depends on the costs alone. Blocks wait in buckets of keys, not in a heap. And where a
/// distance became void, look-aheads that led over it are found anew only when it is their block's
/// turn: once, after all that they led over.
///
/// 16 bytes a block of the ring, which has up to three times the blocks of the grid.
class DistanceField {
 public:
  /// Of a path there is none of.
  static constexpr std::uint32_t kNone = std::numeric_limits<std::int32_t>::max();

  /// Sets costs and goals. Goals that are blocked or outside the grid do not count. Repairs the
  /// blocks that changed, if the costs say which, and compares all otherwise. Blocks are held in a
  /// ring: where the grid moves on, only what comes and goes is touched.
  void take_in(const Costmap& costs, const std::vector<Cell>& goals);

  /// The least cost from the block of a cell, in 1/96 of a block that costs 1; kNone if there is no
  /// path. The cell lies within the grid.
  std::uint32_t settle(const Cell& start);

  /// A path of least cost from the settled start to a goal, both included; no places if there is
  /// none. It leads over the middles of blocks without a blocked cell, and elsewhere from cell to
  /// touching cell. At each block it takes the first of equally good steps, counter-clockwise from
  /// that along x.
  void path(const Costmap& costs, std::vector<Vec2>& places) const;

 private:
  static constexpr std::uint32_t kNotQueued = std::numeric_limits<std::uint32_t>::max();
  /// Of a look-ahead that is void; the block waits, and finds it anew when it is its turn.
  static constexpr std::uint32_t kVoid = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::size_t kSteps = 8;

  struct Node {
    std::uint32_t distance = kNone;     ///< g
    std::uint32_t look_ahead = kNone;   ///< rhs: over the best neighbour; or kVoid
    std::uint32_t queued = kNotQueued;  ///< a key of the first bucket that it waits in
    std::uint16_t weight = 0;           ///< cost in quarters; 0: blocked
    std::uint8_t members = 0;           ///< bit i: cell i is not blocked; bit 4 + i: it is a goal
    std::uint8_t open = 0;              ///< bit i: step i leads somewhere

    bool is_goal() const { return (members & members >> 4) != 0; }
  };

  /// Columns and rows of blocks, from one to another.
  struct Outline {
    Cell least;
    Cell most;
  };

  bool is_told(const Costmap& costs) const;
  void take_changed(const Costmap& costs);
  bool lay(const Grid& grid);
  void keep_laid_out(const Grid& before);
  void queue_anew();
  static Node free_node();
  void close_border(const Outline& before);
  void open_border(const Outline& before);
  void note(const Cell& block);
  void clear();
  void compare_all(const Costmap& costs);
  void take_block(const Costmap& costs, const Cell& block);
  void set_goals(const std::vector<Cell>& goals);
  void repair();
  std::uint8_t open_steps(std::uint32_t at) const;
  /// Over which neighbours a look-ahead may lead. Those whose own is void offer their distance when
  /// it is their turn and they keep it.
  enum class Among : std::uint8_t { kAll, kNotVoid };
  std::uint32_t best_look_ahead(std::uint32_t at, Among among) const;
  void expand(std::uint32_t at, const Cell& block);
  void lower_around(std::uint32_t at, const Cell& block);
  void raise_around(std::uint32_t at, const Cell& block);
  void queue(std::uint32_t at, const Cell& block);
  void queue_with(std::uint32_t key, std::uint32_t at);
  void look_afresh(std::uint32_t at, const Cell& block);
  std::uint32_t key(const Node& node, const Cell& block) const;
  std::uint32_t estimate(const Cell& from, const Cell& to) const;
  std::size_t best_step(std::uint32_t at) const;
  Vec2 place_in(const Costmap& costs, std::uint32_t at, std::uint8_t of) const;

  std::uint32_t at(const Cell& block) const {
    return static_cast<std::uint32_t>(blocks_.index(block));
  }
  Cell block_at(std::uint32_t at) const { return blocks_.cell(at); }
  std::uint32_t beside(std::uint32_t at, std::size_t step) const {
    return (at + offsets_[step]) & last_place_;
  }
  static Cell block_of(const Cell& cell) { return {cell.column / 2 + 1, cell.row / 2 + 1}; }

  Grid grid_;                                    // of the cells
  Grid blocks_;                                  // with a border of one blocked block
  std::array<std::uint32_t, kSteps> offsets_{};  // of the neighbours; those below wrap around
  std::uint32_t last_place_ = 0;                 // of the ring of blocks
  std::uint64_t revision_ = 0;                   // of the costs that are taken in
  std::vector<Node> nodes_;
  std::vector<Node> spare_;
  std::vector<Cell> goals_;
  std::vector<std::uint32_t> changed_;  // blocks whose cost or cells are others
  std::vector<std::uint32_t> touched_;  // those and their neighbours
  std::vector<std::uint8_t> is_touched_;
  BucketQueue queue_;  // a block may wait more than once
  Cell start_cell_;
  Cell start_;               // its block
  std::uint32_t moved_ = 0;  // km: the sum of the estimates from start to start
};

// These are where the time goes: they are here so that they are inlined.

inline std::uint32_t DistanceField::estimate(const Cell& from, const Cell& to) const {
  const auto columns = static_cast<std::uint32_t>(std::abs(to.column - from.column));
  const auto rows = static_cast<std::uint32_t>(std::abs(to.row - from.row));
  constexpr std::uint32_t kStraight = 2 * kWeightOfOne * kBlockSteps[0].length;
  constexpr std::uint32_t kDiagonal = 2 * kWeightOfOne * kBlockSteps[1].length;
  return kStraight * std::max(columns, rows) + (kDiagonal - kStraight) * std::min(columns, rows);
}

/// A path from the start over that block costs at least this, but for moved_.
inline std::uint32_t DistanceField::key(const Node& node, const Cell& block) const {
  return std::min(node.distance, node.look_ahead) + estimate(start_, block) + moved_;
}

inline void DistanceField::queue_with(std::uint32_t key, std::uint32_t at) {
  Node& node = nodes_[at];
  if (!BucketQueue::is_later(node.queued, key)) return;
  node.queued = key;
  queue_.push({key, at});
}

/// A block that is not settled waits, with the least of its keys.
inline void DistanceField::queue(std::uint32_t at, const Cell& block) {
  const Node& node = nodes_[at];
  if (node.distance == node.look_ahead) return;
  queue_with(key(node, block), at);
}

}  // namespace clew::map

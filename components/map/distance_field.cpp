// SPDX-License-Identifier: Apache-2.0
#include "map/distance_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/check.hpp"
#include "map/block_steps.hpp"

namespace clew::map {
namespace {

// A path of 8 km through the dearest cells costs less than kNone.
constexpr float kMostWeight = 1000.0F;
// Keys grow as the start moves; before they reach the last bucket, all is made anew.
constexpr std::uint32_t kMostMoved = 1U << 20;
// So many may wait for each block; some are there twice, since a lower key came later.
constexpr std::size_t kMostWaiting = 4;

std::uint16_t weight_of(float cost) {
  return static_cast<std::uint16_t>(
      std::clamp(cost * kWeightOfOne + 0.5F, static_cast<float>(kWeightOfOne), kMostWeight));
}

Cell stepped(const Cell& block, const BlockStep& step) {
  return {block.column + step.columns, block.row + step.rows};
}

/// Calls `visit(step)` for each bit. Most blocks have all: of these, lengths are constants.
template <typename Visit>
inline void for_each_step(std::uint8_t steps, Visit&& visit) {
  if (steps == 0xFF) {
#pragma GCC unroll 8
    for (std::size_t i = 0; i < kBlockSteps.size(); ++i) visit(i);
    return;
  }
  for (std::uint32_t left = steps; left != 0; left &= left - 1) {
    visit(static_cast<std::size_t>(__builtin_ctz(left)));
  }
}

}  // namespace

void DistanceField::take_in(const Costmap& costs, const std::vector<Cell>& goals) {
  changed_.clear();
  const bool is_first = nodes_.empty();
  bool told = is_told(costs);
  if (costs.grid != grid_ && !lay(costs.grid)) told = told && is_first;
  grid_ = costs.grid;
  if (moved_ > kMostMoved || queue_.places() > kMostWaiting * nodes_.size()) clear();
  if (told) {
    take_changed(costs);
  } else {
    compare_all(costs);
  }
  revision_ = costs.revision;
  set_goals(goals);
  repair();
}

/// Whether the costs tell all that differs from what was taken in last; before that, all blocks are
/// free.
bool DistanceField::is_told(const Costmap& costs) const {
  if (nodes_.empty()) return costs.tells_moves && costs.revision == 1;
  const bool follows = costs.revision == revision_ || costs.revision == revision_ + 1;
  return revision_ > 0 && follows && (costs.tells_moves || costs.grid == grid_);
}

void DistanceField::take_changed(const Costmap& costs) {
  touched_.clear();
  for (const std::size_t index : costs.changed) {
    const std::uint32_t place = at(block_of(costs.grid.cell(index)));
    if (is_touched_[place] != 0) continue;
    is_touched_[place] = 1;
    touched_.push_back(place);
  }
  for (const std::uint32_t place : touched_) {
    is_touched_[place] = 0;
    take_block(costs, block_at(place));
  }
}

/// Forgets all distances; costs and goals stay.
void DistanceField::clear() {
  queue_.clear();
  moved_ = 0;
  for (Node& node : nodes_) {
    node.distance = kNone;
    node.look_ahead = node.is_goal() ? 0 : kNone;
    node.queued = kNotQueued;
  }
  for (const Cell& goal : goals_) {
    if (grid_.contains(goal)) queue(at(block_of(goal)), block_of(goal));
  }
}

void DistanceField::compare_all(const Costmap& costs) {
  for (std::int32_t row = 1; row < blocks_.rows - 1; ++row) {
    for (std::int32_t column = 1; column < blocks_.columns - 1; ++column) {
      take_block(costs, {column, row});
    }
  }
}

/// Takes the costs of a block's cells over; those in the border are blocked.
void DistanceField::take_block(const Costmap& costs, const Cell& block) {
  const Cell first{2 * (block.column - 1), 2 * (block.row - 1)};
  float sum = 0.0F;
  float count = 0.0F;
  unsigned members = 0;
  for (unsigned i = 0; i < 4; ++i) {
    const Cell cell{first.column + static_cast<std::int32_t>(i % 2),
                    first.row + static_cast<std::int32_t>(i / 2)};
    if (!grid_.contains(cell)) continue;
    const float cost = costs.cost[grid_.index(cell)];
    if (cost == Costmap::kBlocked) continue;
    sum += cost;
    count += 1.0F;
    members |= 1U << i;
  }
  const std::uint16_t weight = members == 0 ? std::uint16_t{0} : weight_of(sum / count);
  const std::uint32_t place = at(block);
  Node& node = nodes_[place];
  if (node.weight == weight && (node.members & kAllMembers) == members) return;
  node.weight = weight;
  node.members = static_cast<std::uint8_t>((node.members & ~unsigned{kAllMembers}) | members);
  changed_.push_back(place);
}

void DistanceField::set_goals(const std::vector<Cell>& goals) {
  if (goals == goals_) return;
  const auto bit_of = [](const Cell& goal) {
    return 1U << (4 + goal.column % 2 + 2 * (goal.row % 2));
  };
  for (const Cell& goal : goals_) {
    if (grid_.contains(goal)) nodes_[at(block_of(goal))].members &= kAllMembers;
  }
  goals_ = goals;
  for (const Cell& goal : goals_) {
    if (!grid_.contains(goal)) continue;
    Node& node = nodes_[at(block_of(goal))];
    node.members = static_cast<std::uint8_t>(node.members | bit_of(goal));
  }
  // Nearly all distances are others.
  clear();
}

/// Takes over what has changed, for the blocks themselves and for their neighbours.
void DistanceField::repair() {
  touched_.clear();
  const auto touch = [&](std::uint32_t place) {
    if (is_touched_[place] != 0) return;
    is_touched_[place] = 1;
    touched_.push_back(place);
  };
  for (const std::uint32_t place : changed_) {
    touch(place);
    for (std::size_t i = 0; i < kSteps; ++i) touch(beside(place, i));
  }
  for (const std::uint32_t place : touched_) {
    is_touched_[place] = 0;
    nodes_[place].open = open_steps(place);
  }
  for (const std::uint32_t place : touched_) {
    Node& node = nodes_[place];
    const std::uint32_t best = best_look_ahead(place, Among::kAll);
    // A void one that keeps its distance has yet to offer it to its neighbours.
    const bool stays_void =
        node.look_ahead == kVoid && node.distance < kNone && best >= node.distance;
    if (!stays_void) node.look_ahead = best;
    queue(place, block_at(place));
  }
}

/// Blocks of the border have no cells that are not blocked.
std::uint8_t DistanceField::open_steps(std::uint32_t at) const {
  const Node& node = nodes_[at];
  if (node.weight == 0) return 0;
  unsigned open = 0;
  for (std::size_t i = 0; i < kSteps; ++i) {
    const BlockStep& step = kBlockSteps[i];
    const bool leads =
        (node.members & step.own) != 0 && (nodes_[beside(at, i)].members & step.other) != 0;
    open |= (leads ? 1U : 0U) << i;
  }
  return static_cast<std::uint8_t>(open);
}

std::uint32_t DistanceField::best_look_ahead(std::uint32_t at, Among among) const {
  const Node& node = nodes_[at];
  if (node.is_goal()) return 0;
  std::uint32_t best = kNone;
  for_each_step(node.open, [&](std::size_t i) {
    const Node& next = nodes_[beside(at, i)];
    if (among == Among::kNotVoid && next.look_ahead == kVoid) return;
    // Not below kNone where the neighbour has no distance.
    const std::uint32_t weights = std::uint32_t{node.weight} + next.weight;
    best = std::min(best, next.distance + kBlockSteps[i].length * weights);
  });
  return best;
}

std::uint32_t DistanceField::settle(const Cell& start) {
  start_cell_ = start;
  const Cell block = block_of(start);
  moved_ += estimate(start_, block);
  start_ = block;
  const std::uint32_t place = at(block);
  const Node& here = nodes_[place];
  if (here.weight == 0) return kNone;
  while (true) {
    if (here.look_ahead == kVoid) look_afresh(place, block);
    // Up to here, blocks may lie on a best path from the start.
    const auto waiting = queue_.take_up_to(here.look_ahead + moved_);
    if (!waiting) break;
    Node& node = nodes_[waiting->who];
    if (!BucketQueue::is_same(node.queued, waiting->key)) continue;
    node.queued = kNotQueued;
    const Cell next = block_at(waiting->who);
    if (node.look_ahead == kVoid && BucketQueue::is_later(key(node, next), waiting->key)) {
      // Another neighbour may lead nearer than its distance is.
      const std::uint32_t best = best_look_ahead(waiting->who, Among::kNotVoid);
      if (best < node.distance || node.distance == kNone) node.look_ahead = best;
    }
    if (node.distance == node.look_ahead) continue;
    // The start has moved since.
    const std::uint32_t now = key(node, next);
    if (BucketQueue::is_later(now, waiting->key)) {
      queue_with(now, waiting->who);
    } else {
      expand(waiting->who, next);
    }
  }
  return here.look_ahead;
}

/// Finds a look-ahead that is void anew, for now: over neighbours whose own is void, too.
void DistanceField::look_afresh(std::uint32_t at, const Cell& block) {
  Node& node = nodes_[at];
  node.look_ahead = best_look_ahead(at, Among::kAll);
  if (node.look_ahead == node.distance && node.distance < kNone) lower_around(at, block);
  queue(at, block);
}

void DistanceField::expand(std::uint32_t at, const Cell& block) {
  Node& node = nodes_[at];
  const std::uint32_t before = node.distance;
  if (before > node.look_ahead) {
    node.distance = node.look_ahead;
    lower_around(at, block);
  } else if (before < node.look_ahead) {
    raise_around(at, block);
  }
}

/// A block's distance fell, or stands after all: its neighbours' may fall.
void DistanceField::lower_around(std::uint32_t at, const Cell& block) {
  const Node node = nodes_[at];
  for_each_step(node.open, [&](std::size_t i) {
    const std::uint32_t near = beside(at, i);
    Node& next = nodes_[near];
    const std::uint32_t weights = std::uint32_t{node.weight} + next.weight;
    const std::uint32_t offered = node.distance + kBlockSteps[i].length * weights;
    if (offered >= next.look_ahead) return;
    const Cell there = stepped(block, kBlockSteps[i]);
    if (next.look_ahead == kVoid) {
      queue_with(offered + estimate(start_, there) + moved_, near);
      return;
    }
    next.look_ahead = offered;
    queue(near, there);
  });
}

/// A block's distance may be void. Its look-ahead is found anew, but not over neighbours that lead
/// over the block itself: whether they keep their distances is told when it is their turn, and then
/// they offer it. If none of the others leads as near, the distance is void, and their look-aheads.
void DistanceField::raise_around(std::uint32_t at, const Cell& block) {
  Node& node = nodes_[at];
  const std::uint32_t before = node.distance;
  std::uint32_t best = node.is_goal() ? 0 : kNone;
  unsigned leads_here = 0;
  for_each_step(node.open, [&](std::size_t i) {
    const Node& next = nodes_[beside(at, i)];
    const std::uint32_t step = kBlockSteps[i].length * (std::uint32_t{node.weight} + next.weight);
    const bool leads = next.look_ahead == before + step;
    const bool led = next.look_ahead == kVoid && next.distance == before + step;
    leads_here |= (leads ? 1U : 0U) << i;
    if (!leads && !led) best = std::min(best, next.distance + step);
  });
  node.look_ahead = best;
  if (best <= before) {
    node.distance = best;
    lower_around(at, block);
    return;
  }
  node.distance = kNone;
  for_each_step(static_cast<std::uint8_t>(leads_here), [&](std::size_t i) {
    const std::uint32_t near = beside(at, i);
    nodes_[near].look_ahead = kVoid;
    queue(near, stepped(block, kBlockSteps[i]));
  });
  queue(at, block);
}

/// The middle of the cheapest of some cells of a block, one of which is not blocked.
Vec2 DistanceField::place_in(const Costmap& costs, std::uint32_t at, std::uint8_t of) const {
  const Cell block = block_at(at);
  const unsigned members = nodes_[at].members & of;
  Cell cheapest;
  float least = std::numeric_limits<float>::infinity();
  for (unsigned i = 0; i < 4; ++i) {
    if ((members >> i & 1U) == 0) continue;
    const Cell cell{2 * (block.column - 1) + static_cast<std::int32_t>(i % 2),
                    2 * (block.row - 1) + static_cast<std::int32_t>(i / 2)};
    const float cost = costs.cost[grid_.index(cell)];
    if (cost >= least) continue;
    least = cost;
    cheapest = cell;
  }
  return grid_.centre(cheapest);
}

void DistanceField::path(const Costmap& costs, std::vector<Vec2>& places) const {
  places.clear();
  std::uint32_t here = at(block_of(start_cell_));
  if (nodes_[here].look_ahead == kNone) return;
  const auto add = [&](const Vec2& place) {
    if (places.empty() || places.back() != place) places.push_back(place);
  };
  const auto is_free = [&](std::uint32_t at) {
    return (nodes_[at].members & kAllMembers) == kAllMembers;
  };
  add(grid_.centre(start_cell_));
  while (nodes_[here].distance > 0) {
    const std::size_t i = best_step(here);
    const BlockStep& step = kBlockSteps[i];
    const std::uint32_t next = beside(here, i);
    if (!is_free(here)) add(place_in(costs, here, step.own));
    add(is_free(next) ? blocks_.centre(block_at(next)) : place_in(costs, next, step.other));
    here = next;
  }
  add(place_in(costs, here, static_cast<std::uint8_t>(nodes_[here].members >> 4)));
}

std::size_t DistanceField::best_step(std::uint32_t at) const {
  const Node& node = nodes_[at];
  std::uint32_t best = kNone;
  std::size_t best_step = 0;
  for_each_step(node.open, [&](std::size_t i) {
    const Node& next = nodes_[beside(at, i)];
    const std::uint32_t weights = std::uint32_t{node.weight} + next.weight;
    const std::uint32_t over = next.distance + kBlockSteps[i].length * weights;
    if (over >= best) return;
    best = over;
    best_step = i;
  });
  CLEW_CHECK(best == node.distance, "a path that is not settled");
  return best_step;
}

}  // namespace clew::map

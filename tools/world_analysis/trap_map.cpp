// SPDX-License-Identifier: Apache-2.0
#include "world_analysis/trap_map.hpp"

#include <algorithm>
#include <numeric>

namespace clew::world_analysis {

/// Rises from the target through the free nodes, in the order of their distance. What has been
/// reached falls into components, each with its lowest node. Where two meet, the one that began
/// higher ends: its lowest node is a local minimum, and the meeting place its pass.
class TrapMap::Flood {
 public:
  Flood(TrapMap& map, const ClearanceGrid& grid, double least_depth_m)
      : map_(map),
        grid_(grid),
        least_depth_m_(least_depth_m),
        parent_(grid.size(), kNone),
        next_(grid.size(), kNone),
        last_(grid.size()),
        distances_m_(grid.size()) {}

  void run() {
    std::vector<std::uint32_t> order;
    for (std::uint32_t node = 0; node < grid_.size(); ++node) {
      if (!map_.is_free_[node]) continue;
      distances_m_[node] = core::length(grid_.position(node) - grid_.world().target());
      order.push_back(node);
    }
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return distances_m_[a] != distances_m_[b] ? distances_m_[a] < distances_m_[b] : a < b;
    });
    for (const std::uint32_t node : order) add(node);
    end_what_is_left(order);
    note_what_the_start_reaches();
  }

 private:
  void add(std::uint32_t node) {
    parent_[node] = node;
    last_[node] = node;
    grid_.visit_around(node, 1, [&](std::size_t neighbour) {
      if (parent_[neighbour] == kNone) return;
      join(find(node), find(static_cast<std::uint32_t>(neighbour)), distances_m_[node]);
    });
  }

  /// The lowest node of a node's component.
  std::uint32_t find(std::uint32_t node) {
    while (parent_[node] != node) {
      parent_[node] = parent_[parent_[node]];
      node = parent_[node];
    }
    return node;
  }

  void join(std::uint32_t a, std::uint32_t b, double pass_m) {
    if (a == b) return;
    const bool a_is_lower =
        distances_m_[a] != distances_m_[b] ? distances_m_[a] < distances_m_[b] : a < b;
    const std::uint32_t low = a_is_lower ? a : b;
    const std::uint32_t high = a_is_lower ? b : a;
    end_component(high, pass_m - distances_m_[high]);
    parent_[high] = low;
    next_[last_[low]] = high;
    last_[low] = last_[high];
  }

  void end_component(std::uint32_t lowest, double depth_m) {
    if (depth_m < least_depth_m_) return;
    const auto index = static_cast<std::uint32_t>(map_.traps_.size());
    Trap trap{grid_.position(lowest), distances_m_[lowest], depth_m, 0, std::nullopt, false};
    for (std::uint32_t node = lowest; node != kNone; node = next_[node]) {
      ++trap.nodes;
      std::uint32_t& of_node = map_.trap_of_node_[node];
      if (of_node == kNone) {
        of_node = index;
      } else {
        Trap& outermost = map_.traps_[outermost_of(of_node)];
        outermost.inside_of = index;
      }
    }
    map_.traps_.push_back(trap);
    bottoms_.push_back(lowest);
  }

  std::uint32_t outermost_of(std::uint32_t trap) const {
    const auto& traps = map_.traps_;
    while (traps[trap].inside_of && *traps[trap].inside_of < traps.size()) {
      trap = static_cast<std::uint32_t>(*traps[trap].inside_of);
    }
    return trap;
  }

  /// Rooms without a way to the target. Its own room is that of the lowest node of all, unless the
  /// target is where no robot can be.
  void end_what_is_left(const std::vector<std::uint32_t>& order) {
    const double arrived_m = grid_.world().target_radius_m();
    for (const std::uint32_t node : order) {
      const bool at_target = node == order.front() && distances_m_[node] <= arrived_m;
      if (parent_[node] == node && !at_target) end_component(node, Trap::kNoWayOut);
    }
  }

  /// At the end there is a component for each room of the free space.
  void note_what_the_start_reaches() {
    const auto start = grid_.nearest_free(grid_.world().start().position(), map_.radius_m_);
    if (!start) return;
    const std::uint32_t room = find(static_cast<std::uint32_t>(*start));
    for (std::size_t i = 0; i < bottoms_.size(); ++i) {
      map_.traps_[i].from_start = find(bottoms_[i]) == room;
    }
  }

  TrapMap& map_;
  const ClearanceGrid& grid_;
  double least_depth_m_;
  std::vector<std::uint32_t> bottoms_;  ///< the lowest node of each trap
  std::vector<std::uint32_t> parent_;   ///< union-find; the root is the component's lowest node
  std::vector<std::uint32_t> next_;     ///< a component's nodes as a list that begins at its root
  std::vector<std::uint32_t> last_;     ///< the list's end, at the root
  std::vector<double> distances_m_;
};

TrapMap::TrapMap(const ClearanceGrid& grid, double radius_m, double least_depth_m)
    : grid_(&grid), radius_m_(radius_m), trap_of_node_(grid.size(), kNone), is_free_(grid.size()) {
  for (std::size_t node = 0; node < grid.size(); ++node) {
    is_free_[node] = grid.clearance_m(node) >= radius_m;
  }
  Flood(*this, grid, least_depth_m).run();
}

std::optional<std::size_t> TrapMap::trap_at(const Vec2& position) const {
  const auto node = grid_->nearest_free(position, radius_m_);
  if (!node || trap_of_node_[*node] == kNone) return std::nullopt;
  return trap_of_node_[*node];
}

}  // namespace clew::world_analysis

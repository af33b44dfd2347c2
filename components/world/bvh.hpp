// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace clew::world {

/// An axis-aligned rectangle, metres.
struct Box {
  double min_x = 0.0;
  double min_y = 0.0;
  double max_x = 0.0;
  double max_y = 0.0;
};

/// A static tree of boxes (bounding volume hierarchy), so that a query looks at few of many items.
/// It holds no items: the owner keeps them in the tree's order, in which each leaf is a range.
class Bvh {
 public:
  Bvh() = default;
  /// One box an item. Each is widened a little, so that rounding in a bound never hides an item.
  explicit Bvh(const std::vector<Box>& boxes);

  /// order()[place] = index of the item, in the boxes given, that belongs at that place.
  const std::vector<std::uint32_t>& order() const { return order_; }

  /// Calls visit(place) for the items of all leaves whose bound(box) is below `limit`, leaves with
  /// the least bound first. `bound` is a lower limit of what the visit may find in a box; `visit`
  /// lowers `limit` as it finds. It allocates nothing.
  template <typename Bound, typename Visit>
  void visit_nearest_first(const Bound& bound, const double& limit, const Visit& visit) const;

 private:
  static constexpr std::size_t kLeafSize = 4;
  static constexpr std::size_t kDeepest = 64;  // half of it by splits, then 2^32 items by halving

  struct Node {
    Box box;
    std::uint32_t first = 0;  // leaf: place of its first item; else: the right child
    std::uint32_t count = 0;  // leaf: its items; else 0, and the left child is the next node
  };
  std::size_t split(const std::vector<Box>& boxes, std::size_t first, std::size_t last);
  std::uint32_t build(const std::vector<Box>& boxes, std::size_t first, std::size_t last,
                      std::size_t depth);

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
};

template <typename Bound, typename Visit>
void Bvh::visit_nearest_first(const Bound& bound, const double& limit, const Visit& visit) const {
  if (nodes_.empty()) return;
  struct Pending {
    std::uint32_t node;
    double bound;
  };
  std::array<Pending, kDeepest + 1> stack;  // one waits a level, and the two of the last
  std::size_t depth = 0;
  stack[depth++] = {0, bound(nodes_[0].box)};
  while (depth > 0) {
    const Pending next = stack[--depth];
    if (!(next.bound < limit)) continue;
    const Node& node = nodes_[next.node];
    if (node.count > 0) {
      for (std::uint32_t i = 0; i < node.count; ++i) visit(node.first + i);
      continue;
    }
    Pending near{next.node + 1, bound(nodes_[next.node + 1].box)};
    Pending far{node.first, bound(nodes_[node.first].box)};
    if (far.bound < near.bound) std::swap(near, far);
    if (far.bound < limit) stack[depth++] = far;
    if (near.bound < limit) stack[depth++] = near;
  }
}

}  // namespace clew::world

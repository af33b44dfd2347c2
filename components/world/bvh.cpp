// SPDX-License-Identifier: Apache-2.0
#include "world/bvh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace clew::world {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Far above the rounding of a bound, far below what matters: 1e-9 m at 1 m.
Box widened(const Box& box) {
  const double largest = std::max(std::max(std::fabs(box.min_x), std::fabs(box.max_x)),
                                  std::max(std::fabs(box.min_y), std::fabs(box.max_y)));
  const double slack = 1e-9 * (1.0 + largest);
  return {box.min_x - slack, box.min_y - slack, box.max_x + slack, box.max_y + slack};
}

// The box around some boxes.
struct Extent {
  Box box{kInfinity, kInfinity, -kInfinity, -kInfinity};
  std::size_t count = 0;

  void add(const Extent& other) {
    box.min_x = std::min(box.min_x, other.box.min_x);
    box.min_y = std::min(box.min_y, other.box.min_y);
    box.max_x = std::max(box.max_x, other.box.max_x);
    box.max_y = std::max(box.max_y, other.box.max_y);
    count += other.count;
  }
  void add(const Box& one) { add(Extent{one, 1}); }
  // What a random line costs here: the chance to hit the box times the items to look at.
  double cost() const {
    if (count == 0) return 0.0;
    return (box.max_x - box.min_x + box.max_y - box.min_y) * static_cast<double>(count);
  }
};

// Equal slices of the space that the centres of some boxes take along one axis.
class Slices {
 public:
  static constexpr std::size_t kCount = 16;

  Slices(const Extent& centres, bool along_x)
      : along_x_(along_x),
        min_(along_x ? centres.box.min_x : centres.box.min_y),
        slices_per_unit_(kCount / ((along_x ? centres.box.max_x : centres.box.max_y) - min_)) {}

  // The centre, doubled: only its place among the others matters.
  static Box centre(const Box& box) {
    const double x = box.min_x + box.max_x;
    const double y = box.min_y + box.max_y;
    return {x, y, x, y};
  }
  std::size_t slice_of(const Box& box) const {
    const Box point = centre(box);
    const double slice = ((along_x_ ? point.min_x : point.min_y) - min_) * slices_per_unit_;
    // Not a number if all centres are the same.
    return slice < kCount - 1 ? static_cast<std::size_t>(slice) : kCount - 1;
  }

 private:
  bool along_x_;
  double min_;
  double slices_per_unit_;
};

struct Cut {
  double cost = kInfinity;
  std::size_t after = 0;  // the last slice of the first part
};

Cut best_cut(const std::array<Extent, Slices::kCount>& slices) {
  std::array<double, Slices::kCount> above{};  // cost of all slices after this one
  Extent extent;
  for (std::size_t i = Slices::kCount - 1; i > 0; --i) {
    extent.add(slices[i]);
    above[i - 1] = extent.count > 0 ? extent.cost() : kInfinity;
  }
  Cut best;
  extent = Extent();
  for (std::size_t i = 0; i + 1 < Slices::kCount; ++i) {
    extent.add(slices[i]);
    const double cost = extent.cost() + above[i];
    if (extent.count > 0 && cost < best.cost) best = {cost, i};
  }
  return best;
}

}  // namespace

Bvh::Bvh(const std::vector<Box>& boxes) : order_(boxes.size()) {
  if (boxes.empty()) return;
  std::iota(order_.begin(), order_.end(), 0U);
  build(boxes, 0, boxes.size(), 0);
}

// Splits the items where the sum of both parts' costs is least: the surface area heuristic of
// MacDonald and Booth 1990, "Heuristics for ray tracing using space subdivision".
// Deviation: only the borders of 16 slices an axis are tried, as in Wald 2007, "On fast
// construction of SAH-based bounding volume hierarchies"; in the plane the perimeter stands for the
// surface.
std::size_t Bvh::split(const std::vector<Box>& boxes, std::size_t first, std::size_t last) {
  Extent centres;
  for (std::size_t i = first; i < last; ++i) centres.add(Slices::centre(boxes[order_[i]]));
  Cut best;
  bool best_along_x = true;
  for (const bool along_x : {true, false}) {
    const Slices slices(centres, along_x);
    std::array<Extent, Slices::kCount> extents;
    for (std::size_t i = first; i < last; ++i) {
      const Box& box = boxes[order_[i]];
      extents[slices.slice_of(box)].add(box);
    }
    const Cut cut = best_cut(extents);
    if (cut.cost < best.cost) {
      best = cut;
      best_along_x = along_x;
    }
  }
  if (best.cost == kInfinity) return first + (last - first) / 2;  // all centres are the same
  const Slices slices(centres, best_along_x);
  const auto begin = order_.begin();
  const auto middle = std::stable_partition(
      begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(last),
      [&](std::uint32_t item) { return slices.slice_of(boxes[item]) <= best.after; });
  return static_cast<std::size_t>(middle - begin);
}

std::uint32_t Bvh::build(const std::vector<Box>& boxes, std::size_t first, std::size_t last,
                         std::size_t depth) {
  Extent extent;
  for (std::size_t i = first; i < last; ++i) extent.add(widened(boxes[order_[i]]));
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({extent.box, static_cast<std::uint32_t>(first), 0});
  if (last - first <= kLeafSize) {
    nodes_[index].count = static_cast<std::uint32_t>(last - first);
    return index;
  }
  // Splits can be as uneven as the world; deep down, halving bounds the depth.
  const std::size_t middle =
      depth < kDeepest / 2 ? split(boxes, first, last) : first + (last - first) / 2;
  build(boxes, first, middle, depth + 1);
  nodes_[index].first = build(boxes, middle, last, depth + 1);
  return index;
}

}  // namespace clew::world

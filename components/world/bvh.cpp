// SPDX-License-Identifier: Apache-2.0
#include "world/bvh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace clew::world {
namespace {

// Far above the rounding of a bound, far below what matters: 1e-9 m at 1 m.
Box widened(const Box& box) {
  const double largest = std::max(std::max(std::fabs(box.min_x), std::fabs(box.max_x)),
                                  std::max(std::fabs(box.min_y), std::fabs(box.max_y)));
  const double slack = 1e-9 * (1.0 + largest);
  return {box.min_x - slack, box.min_y - slack, box.max_x + slack, box.max_y + slack};
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Extent {
  Box all{kInfinity, kInfinity, -kInfinity, -kInfinity};

  void add(const Box& box) {
    all.min_x = std::min(all.min_x, box.min_x);
    all.min_y = std::min(all.min_y, box.min_y);
    all.max_x = std::max(all.max_x, box.max_x);
    all.max_y = std::max(all.max_y, box.max_y);
  }
};

}  // namespace

Bvh::Bvh(const std::vector<Box>& boxes) : order_(boxes.size()) {
  if (boxes.empty()) return;
  std::iota(order_.begin(), order_.end(), 0U);
  nodes_.reserve(2 * boxes.size() / kLeafSize + 1);
  build(boxes, 0, boxes.size());
}

// Halves the items at the median of their centres along the longer side: depth and cost are sure,
// whatever the world.
std::uint32_t Bvh::build(const std::vector<Box>& boxes, std::size_t first, std::size_t last) {
  Extent extent;
  Extent centres;  // doubled
  for (std::size_t i = first; i < last; ++i) {
    const Box& box = boxes[order_[i]];
    extent.add(widened(box));
    const double x = box.min_x + box.max_x;
    const double y = box.min_y + box.max_y;
    centres.add({x, y, x, y});
  }
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({extent.all, static_cast<std::uint32_t>(first), 0});
  if (last - first <= kLeafSize) {
    nodes_[index].count = static_cast<std::uint32_t>(last - first);
    return index;
  }
  const bool along_x =
      centres.all.max_x - centres.all.min_x >= centres.all.max_y - centres.all.min_y;
  const auto centre = [&](std::uint32_t item) {
    const Box& box = boxes[item];
    return along_x ? box.min_x + box.max_x : box.min_y + box.max_y;
  };
  const std::size_t middle = first + (last - first) / 2;
  const auto begin = order_.begin();
  std::nth_element(
      begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(middle),
      begin + static_cast<std::ptrdiff_t>(last), [&](std::uint32_t a, std::uint32_t b) {
        const double ca = centre(a);
        const double cb = centre(b);
        return ca != cb ? ca < cb : a < b;
      });
  build(boxes, first, middle);
  nodes_[index].first = build(boxes, middle, last);
  return index;
}

}  // namespace clew::world

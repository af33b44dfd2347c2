// SPDX-License-Identifier: Apache-2.0
#include "recover/trail.hpp"

#include <algorithm>

namespace clew::recover {

using domain::VirtualObstacle;

void Trail::add(const core::Vec2& position_odom, double travel_m) {
  if (!points_.empty() && core::length(position_odom - points_.back().position_odom) < spacing_m_) {
    return;
  }
  points_.push_back({position_odom, travel_m});
  if (points_.size() > capacity_) points_.pop_front();
}

VirtualObstacle Trail::bounds(double since_travel_m) const {
  VirtualObstacle box;
  bool first = true;
  for (auto point = points_.rbegin(); point != points_.rend(); ++point) {
    if (!first && point->travel_m < since_travel_m) break;
    const core::Vec2& p = point->position_odom;
    if (first) box = {p.x(), p.y(), p.x(), p.y()};
    box = {std::min(box.x_min_m, p.x()), std::min(box.y_min_m, p.y()), std::max(box.x_max_m, p.x()),
           std::max(box.y_max_m, p.y())};
    first = false;
  }
  return box;
}

}  // namespace clew::recover

// SPDX-License-Identifier: Apache-2.0
#include "recover/escapes/boxes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace clew::recover {
namespace {

double width_m(const VirtualObstacle& box) { return box.x_max_m - box.x_min_m; }
double height_m(const VirtualObstacle& box) { return box.y_max_m - box.y_min_m; }
bool is_thin(const VirtualObstacle& box, double least_m) {
  return width_m(box) < least_m || height_m(box) < least_m;
}

core::Vec2 centre(const VirtualObstacle& box) {
  return {0.5 * (box.x_min_m + box.x_max_m), 0.5 * (box.y_min_m + box.y_max_m)};
}

VirtualObstacle around(const core::Vec2& middle, double width, double height) {
  return {middle.x() - 0.5 * width, middle.y() - 0.5 * height, middle.x() + 0.5 * width,
          middle.y() + 0.5 * height};
}

}  // namespace

VirtualObstacle widened(const VirtualObstacle& box, double least_m) {
  return around(centre(box), std::max(width_m(box), least_m), std::max(height_m(box), least_m));
}

std::optional<VirtualObstacle> cut_clear(const VirtualObstacle& box, const core::Vec2& point_odom,
                                         double clearance_m, double least_m) {
  const double x_low = point_odom.x() - clearance_m;
  const double x_high = point_odom.x() + clearance_m;
  const double y_low = point_odom.y() - clearance_m;
  const double y_high = point_odom.y() + clearance_m;
  if (box.x_min_m >= x_high || box.x_max_m <= x_low || box.y_min_m >= y_high ||
      box.y_max_m <= y_low) {
    return box;
  }
  std::array<VirtualObstacle, 4> cuts = {box, box, box, box};
  cuts[0].x_max_m = x_low;
  cuts[1].x_min_m = x_high;
  cuts[2].y_max_m = y_low;
  cuts[3].y_min_m = y_high;
  std::optional<VirtualObstacle> best;
  for (const VirtualObstacle& cut : cuts) {
    if (is_thin(cut, least_m)) continue;
    if (!best || width_m(cut) * height_m(cut) > width_m(*best) * height_m(*best)) best = cut;
  }
  return best;
}

std::optional<VirtualObstacle> halved(const VirtualObstacle& box, double least_m) {
  const VirtualObstacle half = around(centre(box), 0.5 * width_m(box), 0.5 * height_m(box));
  if (is_thin(half, least_m)) return std::nullopt;
  return half;
}

core::Vec2 point_opposite(const VirtualObstacle& box, const core::Vec2& goal_odom,
                          double beyond_m) {
  const core::Vec2 middle = centre(box);
  const core::Vec2 way = goal_odom - middle;
  const bool left_or_right =
      std::fabs(way.x()) * height_m(box) >= std::fabs(way.y()) * width_m(box);
  if (left_or_right) {
    const double x_m = way.x() > 0.0 ? box.x_min_m - beyond_m : box.x_max_m + beyond_m;
    return {x_m, middle.y()};
  }
  const double y_m = way.y() > 0.0 ? box.y_min_m - beyond_m : box.y_max_m + beyond_m;
  return {middle.x(), y_m};
}

}  // namespace clew::recover

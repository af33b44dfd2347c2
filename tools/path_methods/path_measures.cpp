// SPDX-License-Identifier: Apache-2.0
#include "path_methods/path_measures.hpp"

namespace clew::path_methods {
namespace {

using core::Vec2;

std::vector<Vec2> resampled(const std::vector<Vec2>& path, double step_m) {
  std::vector<Vec2> points = {path.front()};
  double left_m = step_m;  // to the next point
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double piece_m = core::length(path[i] - path[i - 1]);
    double done_m = 0.0;
    for (; piece_m - done_m >= left_m; left_m = step_m) {
      done_m += left_m;
      points.push_back(path[i - 1] + done_m / piece_m * (path[i] - path[i - 1]));
    }
    left_m -= piece_m - done_m;
  }
  return points;
}

}  // namespace

double length_m(const std::vector<Vec2>& path) {
  double sum_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) sum_m += core::length(path[i] - path[i - 1]);
  return sum_m;
}

double squared_turning_rad2(const std::vector<Vec2>& path, double step_m) {
  const std::vector<Vec2> points = resampled(path, step_m);
  double sum_rad2 = 0.0;
  for (std::size_t i = 2; i < points.size(); ++i) {
    const Vec2 before = points[i - 1] - points[i - 2];
    const Vec2 after = points[i] - points[i - 1];
    const double turn_rad =
        core::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after));
    sum_rad2 += turn_rad * turn_rad;
  }
  return sum_rad2;
}

}  // namespace clew::path_methods

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

#include "core/geometry.hpp"
#include "plot/svg_writer.hpp"

namespace clew::plot {

/// Where the world lies in the picture: as large as fits, y up.
class MapView {
 public:
  MapView(const core::Vec2& bounds_min, const core::Vec2& bounds_max, const Point& upper_left,
          double max_width_px, double max_height_px)
      : bounds_min_(bounds_min),
        bounds_max_(bounds_max),
        upper_left_(upper_left),
        px_per_m_(std::min(max_width_px / (bounds_max.x() - bounds_min.x()),
                           max_height_px / (bounds_max.y() - bounds_min.y()))) {}

  Point at(const core::Vec2& position) const {
    return {upper_left_.x + (position.x() - bounds_min_.x()) * px_per_m_,
            upper_left_.y + (bounds_max_.y() - position.y()) * px_per_m_};
  }
  std::vector<Point> at(const std::vector<core::Vec2>& positions) const {
    std::vector<Point> points;
    points.reserve(positions.size());
    for (const core::Vec2& position : positions) points.push_back(at(position));
    return points;
  }
  double px(double length_m) const { return length_m * px_per_m_; }

  double left() const { return upper_left_.x; }
  double top() const { return upper_left_.y; }
  double width() const { return px(bounds_max_.x() - bounds_min_.x()); }
  double height() const { return px(bounds_max_.y() - bounds_min_.y()); }
  double right() const { return left() + width(); }
  double bottom() const { return top() + height(); }

 private:
  core::Vec2 bounds_min_;
  core::Vec2 bounds_max_;
  Point upper_left_;
  double px_per_m_;
};

}  // namespace clew::plot

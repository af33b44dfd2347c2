// SPDX-License-Identifier: Apache-2.0
#include "plot/world_layer.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "plot/palette.hpp"

namespace clew::plot {
namespace {

using core::Vec2;

std::vector<double> multiples_between(double step, double low, double high) {
  const double first = std::ceil(low / step);
  const double last = std::floor(high / step);
  std::vector<double> multiples(static_cast<std::size_t>(std::max(last - first + 1.0, 0.0)));
  for (std::size_t i = 0; i < multiples.size(); ++i) {
    multiples[i] = (first + static_cast<double>(i)) * step;
  }
  return multiples;
}

void draw_grid(SvgWriter& svg, const MapView& view, const world::World& world) {
  const Vec2& low = world.bounds_min();
  const Vec2& high = world.bounds_max();
  const double step_m = round_length_m((high - low).maxCoeff() / 2.0);
  std::vector<Point> lines;
  for (const double x_m : multiples_between(step_m, low.x(), high.x())) {
    lines.push_back(view.at({x_m, low.y()}));
    lines.push_back(view.at({x_m, high.y()}));
  }
  for (const double y_m : multiples_between(step_m, low.y(), high.y())) {
    lines.push_back(view.at({low.x(), y_m}));
    lines.push_back(view.at({high.x(), y_m}));
  }
  svg.segments(lines, {"none", kGridGrey, 1.0});
}

/// The grid's metres along the lower and the left border, inside the map.
void draw_axes(SvgWriter& svg, const MapView& view, const world::World& world) {
  constexpr double kLabelPx = 9.5;
  constexpr double kCornerPx = 24.0;  // free of labels of the other axis
  const Vec2& low = world.bounds_min();
  const Vec2& high = world.bounds_max();
  const double step_m = round_length_m((high - low).maxCoeff() / 2.0);
  for (const double x_m : multiples_between(step_m, low.x(), high.x())) {
    const Point at = view.at({x_m, low.y()});
    if (at.x < view.left() + kCornerPx || at.x > view.right() - kCornerPx) continue;
    svg.text({at.x, at.y - 5.0}, short_number(x_m), {kLabelPx, Anchor::kMiddle, kMovingGrey});
  }
  for (const double y_m : multiples_between(step_m, low.y(), high.y())) {
    const Point at = view.at({low.x(), y_m});
    if (at.y < view.top() + kCornerPx || at.y > view.bottom() - kCornerPx) continue;
    svg.text({at.x + 5.0, at.y + 3.5}, short_number(y_m), {kLabelPx, Anchor::kStart, kMovingGrey});
  }
}

void draw_obstacles(SvgWriter& svg, const MapView& view, const world::World& world) {
  const Paint filled{kObstacleGrey, kWallGrey, 1.5};
  for (const auto& polygon : world.polygons()) svg.polygon(view.at(polygon), filled);
  for (const auto& circle : world.circles()) {
    svg.circle(view.at(circle.centre), view.px(circle.radius_m), filled);
  }
  std::vector<Point> walls;
  for (const auto& wall : world.walls()) {
    walls.push_back(view.at(wall.a));
    walls.push_back(view.at(wall.b));
  }
  if (!walls.empty()) svg.segments(walls, {"none", kWallGrey, 3.0});
}

void draw_moving(SvgWriter& svg, const MapView& view, const world::MovingObstacle& obstacle,
                 double end_time_s) {
  std::vector<Point> way;
  for (const auto& waypoint : obstacle.path) way.push_back(view.at(waypoint.position));
  const double radius_px = view.px(obstacle.radius_m);
  svg.polyline(way, {"none", kMovingGrey, 1.2, "6 4"});
  svg.circle(view.at(obstacle.position_at(0.0)), radius_px, {"none", kMovingGrey, 1.2, "3 3"});
  svg.circle(view.at(obstacle.position_at(end_time_s)), radius_px,
             {kObstacleGrey, kMovingGrey, 1.5, "", 0.8});
}

void draw_target(SvgWriter& svg, const MapView& view, const world::Waypoint& target) {
  const Point centre = view.at(target.place);
  const double arm_px = 5.0;
  svg.circle(centre, view.px(target.radius_m), {"#CDEBE1", kGreen, 2.0});
  svg.segments({{centre.x - arm_px, centre.y},
                {centre.x + arm_px, centre.y},
                {centre.x, centre.y - arm_px},
                {centre.x, centre.y + arm_px}},
               {"none", kGreen, 2.0});
}

/// Way-points in their order, joined and numbered; the last one is the target. Numbers of several
/// ways lie side by side.
void draw_way(SvgWriter& svg, const MapView& view, const std::vector<world::Waypoint>& way,
              std::size_t nth) {
  constexpr double kNumberPx = 13.0;
  if (way.empty()) return;
  draw_target(svg, view, way.back());
  if (way.size() == 1) return;
  std::vector<Point> line;
  for (const world::Waypoint& waypoint : way) {
    const Point at = view.at(waypoint.place);
    const double radius_px = view.px(waypoint.radius_m);
    line.push_back(at);
    if (&waypoint != &way.back()) svg.circle(at, radius_px, {"none", kGreen, 1.5});
    svg.text({at.x + 0.75 * radius_px + 3.0 + kNumberPx * static_cast<double>(nth),
              at.y - 0.75 * radius_px - 3.0},
             std::to_string(line.size()), {11.0, Anchor::kStart, kGreen, true});
  }
  svg.polyline(line, {"none", kGreen, 1.0, "3 4"});
}

}  // namespace

double round_length_m(double extent_m) {
  double step_m = 1e-3;
  // 1, 2, 5, 10, ...: the next of the series as long as it stays within a fifth.
  for (int i = 0; step_m * (i % 3 == 1 ? 2.5 : 2.0) <= extent_m / 5.0; ++i) {
    step_m *= i % 3 == 1 ? 2.5 : 2.0;
  }
  return step_m;
}

void draw_world(SvgWriter& svg, const MapView& view, const world::World& world, const Ways& ways,
                double end_time_s, Moving moving) {
  svg.begin_group("world");
  draw_grid(svg, view, world);
  for (std::size_t nth = 0; nth < ways.size(); ++nth) draw_way(svg, view, ways[nth], nth);
  draw_obstacles(svg, view, world);
  for (const auto& obstacle : world.moving()) {
    if (moving == Moving::kNoRobots && obstacle.jumps) continue;
    draw_moving(svg, view, obstacle, end_time_s);
  }
  svg.rectangle({view.left(), view.top()}, view.width(), view.height(), {"none", kWallGrey, 3.0});
  draw_axes(svg, view, world);
  svg.end_group();
}

void draw_start(SvgWriter& svg, const MapView& view, const core::Pose2& start, double radius_m) {
  const Vec2 nose = start.position() + radius_m * core::direction(start.heading_rad);
  svg.circle(view.at(start.position()), view.px(radius_m), {kWhite, kBlack, 1.6});
  svg.line(view.at(start.position()), view.at(nose), {"none", kBlack, 1.6});
}

void draw_scale_bar(SvgWriter& svg, const MapView& view, const world::World& world) {
  const double length_m = round_length_m(world.bounds_max().x() - world.bounds_min().x());
  const double y = view.bottom() + 22.0;
  const double end = view.left() + view.px(length_m);
  svg.segments({{view.left(), y},
                {end, y},
                {view.left(), y - 4.0},
                {view.left(), y + 4.0},
                {end, y - 4.0},
                {end, y + 4.0}},
               {"none", kBlack, 1.6});
  svg.text({end + 8.0, y + 4.0}, short_number(length_m) + " m");
}

}  // namespace clew::plot

// SPDX-License-Identifier: Apache-2.0
#include "plot/tick_picture.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>

#include "plot/map_view.hpp"
#include "plot/page.hpp"
#include "plot/palette.hpp"
#include "plot/svg_writer.hpp"
#include "plot/world_layer.hpp"

namespace clew::plot {
namespace {

using domain::PictureChart;
using domain::PictureLayer;

constexpr double kColumnPx = 300.0;  ///< of legend and charts
constexpr double kChartWidthPx = 240.0;
constexpr double kChartHeightPx = 150.0;
constexpr double kChartLinePx = kChartHeightPx + 80.0;  ///< with its name and labels

/// Of layers of one kind the first, the second, and so on.
constexpr std::array<std::string_view, 4> kWayColours = {kVermilion, kPurple, kGreen, kBlue};
constexpr std::array<std::string_view, 4> kBlockedColours = {kOrange, kPurple, kSkyBlue, kGreen};
constexpr std::array<std::string_view, 4> kGoalColours = {kYellow, kSkyBlue, kPurple, kWhite};
constexpr std::array<std::string_view, 4> kPointColours = {kBlack, kVermilion, kGreen, kBlue};

/// From nearly white at 0 to blue at 1; in a second layer to purple.
std::string shade(double value, std::size_t order = 0) {
  constexpr std::array<double, 3> kPale = {247.0, 251.0, 255.0};
  constexpr std::array<std::array<double, 3>, 2> kDarks = {
      {{0.0, 114.0, 178.0}, {94.0, 33.0, 120.0}}};
  const std::array<double, 3>& dark = kDarks[order % kDarks.size()];
  std::array<int, 3> rgb{};
  for (std::size_t i = 0; i < 3; ++i) {
    rgb[i] = static_cast<int>(kPale[i] + std::clamp(value, 0.0, 1.0) * (dark[i] - kPale[i]) + 0.5);
  }
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "#%02X%02X%02X", static_cast<unsigned>(rgb[0]),
                static_cast<unsigned>(rgb[1]), static_cast<unsigned>(rgb[2]));
  return text.data();
}

void draw_place(SvgWriter& svg, PictureLayer::Kind kind, std::size_t order, const Point& at) {
  if (kind == PictureLayer::Kind::kGoal) {
    svg.circle(at, 5.0, {kGoalColours[order % kGoalColours.size()], kBlack, 1.4});
  } else {
    svg.circle(at, order == 0 ? 1.6 : 2.4, {kPointColours[order % kPointColours.size()]});
  }
}

void draw_layer(SvgWriter& svg, const MapView& view, const FramePair& frames,
                const PictureLayer& layer, std::size_t order) {
  const auto at = [&](const core::Vec2& place) { return view.at(frames.to_world(place)); };
  svg.begin_group(layer.name);
  for (const domain::PictureCell& cell : layer.cells) {
    std::vector<Point> corners;
    for (const core::Vec2& corner : cell.corners_odom) corners.push_back(at(corner));
    const bool blocked = layer.kind == PictureLayer::Kind::kBlocked;
    const std::string fill = blocked ? std::string(kBlockedColours[order % kBlockedColours.size()])
                                     : shade(cell.value, order);
    svg.polygon(corners, {fill, "none", 0.0, "", 0.8});
  }
  if (layer.kind == PictureLayer::Kind::kWay) {
    std::vector<Point> way;
    for (const core::Vec2& place : layer.places_odom) way.push_back(at(place));
    svg.polyline(way, {"none", kWayColours[order % kWayColours.size()], 2.5});
  } else {
    for (const core::Vec2& place : layer.places_odom) {
      draw_place(svg, layer.kind, order, at(place));
    }
  }
  svg.end_group();
}

void draw_legend_line(SvgWriter& svg, const Point& at, const PictureLayer& layer,
                      std::size_t order) {
  if (layer.kind == PictureLayer::Kind::kValues) {
    for (int i = 0; i < 5; ++i) {
      const std::string fill = shade(0.25 * i, order);
      svg.rectangle({at.x + 5.0 * i, at.y - 6.0}, 5.0, 12.0, {fill});
    }
  } else if (layer.kind == PictureLayer::Kind::kBlocked) {
    svg.rectangle({at.x, at.y - 6.0}, 25.0, 12.0,
                  {kBlockedColours[order % kBlockedColours.size()]});
  } else if (layer.kind == PictureLayer::Kind::kWay) {
    svg.line(at, {at.x + 25.0, at.y}, {"none", kWayColours[order % kWayColours.size()], 2.5});
  } else {
    draw_place(svg, layer.kind, order, {at.x + 12.5, at.y});
  }
  svg.text({at.x + 36.0, at.y + 4.0}, layer.name);
}

/// The numbers that a chart's axis spans, half a cell added on both sides.
struct Span {
  double low = 0.0;
  double step = 1.0;
  std::size_t count = 1;

  Span(double first, double last, std::size_t cells)
      : step(cells > 1 ? (last - first) / static_cast<double>(cells - 1) : 1.0), count(cells) {
    if (step <= 0.0) step = 1.0;
    low = first - 0.5 * step;
  }
  double share(double value) const { return (value - low) / (step * static_cast<double>(count)); }
};

void draw_chart(SvgWriter& svg, const Point& corner, const PictureChart& chart) {
  svg.text({corner.x, corner.y}, chart.name, {12.5, Anchor::kStart, kBlack, true});
  if (chart.cells.empty()) return;
  const Point top{corner.x + 36.0, corner.y + 10.0};
  const PictureChart::Cell& first = chart.cells.front();
  const PictureChart::Cell& last = chart.cells.back();
  const Span x(first.x, last.x, chart.columns);
  const Span y(first.y, last.y, chart.cells.size() / chart.columns);
  const double width_px = kChartWidthPx / static_cast<double>(x.count);
  const double height_px = kChartHeightPx / static_cast<double>(y.count);
  const auto at = [&](double cx, double cy) {
    return Point{top.x + x.share(cx) * kChartWidthPx, top.y + (1.0 - y.share(cy)) * kChartHeightPx};
  };
  for (const PictureChart::Cell& cell : chart.cells) {
    const Point middle = at(cell.x, cell.y);
    const std::string fill = cell.allowed ? shade(cell.value) : std::string(kOrange);
    svg.rectangle({middle.x - 0.5 * width_px, middle.y - 0.5 * height_px}, width_px, height_px,
                  {fill, kGridGrey, 0.5});
  }
  svg.circle(at(chart.chosen_x, chart.chosen_y), 5.0, {"none", kVermilion, 2.5});
  const double bottom = top.y + kChartHeightPx;
  svg.text({top.x, bottom + 14.0}, short_number(first.x), {10.5});
  svg.text({top.x + kChartWidthPx, bottom + 14.0}, short_number(last.x), {10.5, Anchor::kEnd});
  svg.text({top.x + 0.5 * kChartWidthPx, bottom + 28.0}, chart.x_label, {10.5, Anchor::kMiddle});
  svg.text({top.x - 4.0, bottom}, short_number(first.y), {10.5, Anchor::kEnd});
  svg.text({top.x - 4.0, top.y + 10.0}, short_number(last.y), {10.5, Anchor::kEnd});
  svg.text({top.x + 0.5 * kChartWidthPx, bottom + 42.0},
           "upward: " + chart.y_label + "; ring: chosen", {10.5, Anchor::kMiddle});
}

void draw_way(SvgWriter& svg, const MapView& view, const RunTrack& track, std::uint64_t tick) {
  std::vector<Point> way;
  for (const auto& [at_tick, frames] : track.frames) {
    if (at_tick <= tick) way.push_back(view.at(frames.world_robot.position()));
  }
  svg.polyline(way, {"none", kBlue, 2.0});
}

/// Where the robot goes at a tick.
std::vector<world::Waypoint> way_at(const RunTrack& track, std::uint64_t tick) {
  std::vector<world::Waypoint> way;
  for (const bridge::GivenMission& mission : track.missions) {
    if (mission.tick <= tick) way = mission.waypoints;
  }
  return way;
}

}  // namespace

std::string draw_tick(const world::World& world, const RunTrack& track, const InsideView& inside) {
  const MapView view(world.bounds_min(), world.bounds_max(), {kMarginPx, kMarginPx + kTitlePx},
                     kMapPx, kMapPx);
  std::size_t layers = 0;
  std::size_t charts = 0;
  for (const domain::Picture& picture : inside.pictures) {
    layers += picture.layers.size();
    charts += picture.charts.size();
  }
  const double column_px = kMarginPx + static_cast<double>(layers) * kLegendLinePx +
                           static_cast<double>(charts) * kChartLinePx;
  SvgWriter svg(view.right() + kMarginPx + kColumnPx,
                view.top() + std::max(view.height() + kFooterPx, column_px));
  const FramePair& frames = track.frames.at(inside.tick);
  const double time_s = track.tick_s * static_cast<double>(inside.tick);
  svg.text(
      {kMarginPx, kMarginPx + 14.0},
      world.name() + ": tick " + std::to_string(inside.tick) + " (" + short_number(time_s) + " s)",
      {18.0, Anchor::kStart, kBlack, true});
  svg.text({kMarginPx, kMarginPx + 36.0}, world.about(), {12.5, Anchor::kStart, "#555555"});
  draw_world(svg, view, world, {way_at(track, inside.tick)}, time_s);
  Point at{view.right() + kMarginPx, view.top() + 10.0};
  std::map<PictureLayer::Kind, std::size_t> orders;
  for (const domain::Picture& picture : inside.pictures) {
    for (const PictureLayer& layer : picture.layers) {
      const std::size_t order = orders[layer.kind]++;
      draw_layer(svg, view, frames, layer, order);
      draw_legend_line(svg, at, layer, order);
      at.y += kLegendLinePx;
    }
  }
  at.y += 10.0;
  for (const domain::Picture& picture : inside.pictures) {
    for (const PictureChart& chart : picture.charts) {
      draw_chart(svg, at, chart);
      at.y += kChartLinePx;
    }
  }
  draw_way(svg, view, track, inside.tick);
  draw_start(svg, view, frames.world_robot, track.robot_radius_m);
  draw_scale_bar(svg, view, world);
  return std::move(svg).finish();
}

}  // namespace clew::plot

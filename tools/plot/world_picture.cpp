// SPDX-License-Identifier: Apache-2.0
#include "plot/world_picture.hpp"

#include <algorithm>

#include "plot/map_view.hpp"
#include "plot/page.hpp"
#include "plot/palette.hpp"
#include "plot/symbols.hpp"
#include "plot/world_layer.hpp"

namespace clew::plot {
namespace {

double last_time_s(const world::World& world) {
  double last_s = 0.0;
  for (const auto& obstacle : world.moving()) {
    last_s = std::max(last_s, obstacle.path.back().time_s);
  }
  return last_s;
}

}  // namespace

std::string draw_empty_world(const world::World& world, double robot_radius_m,
                             const std::vector<core::Vec2>& traps) {
  const MapView view(world.bounds_min(), world.bounds_max(), {kMarginPx, kMarginPx + kTitlePx},
                     kMapPx, kMapPx);
  SvgWriter svg(std::max(view.right(), kMapPx) + kMarginPx, view.bottom() + kFooterPx);
  svg.text({kMarginPx, kMarginPx + 14.0}, world.name(), {18.0, Anchor::kStart, kBlack, true});
  svg.text({kMarginPx, kMarginPx + 36.0}, world.about(), {10.5, Anchor::kStart, "#555555"});
  draw_world(svg, view, world, {world.waypoints()}, last_time_s(world));
  draw_start(svg, view, world.start(), robot_radius_m);
  for (const core::Vec2& trap : traps) draw_symbol(svg, Symbol::kTrap, view.at(trap), kBlack);
  draw_scale_bar(svg, view, world);
  return std::move(svg).finish();
}

}  // namespace clew::plot

// SPDX-License-Identifier: Apache-2.0
#include "plot/symbols.hpp"

#include <vector>

#include "core/math.hpp"
#include "plot/palette.hpp"

namespace clew::plot {
namespace {

/// Corners at equal angles around `centre`, the first one straight up, at the radii in turn.
std::vector<Point> star(const Point& centre, int corners, double outer_px, double inner_px) {
  std::vector<Point> points;
  for (int i = 0; i < corners; ++i) {
    const double angle_rad = 2.0 * core::kPi * i / corners;
    const double radius_px = i % 2 == 0 ? outer_px : inner_px;
    points.push_back(
        {centre.x + radius_px * core::sin(angle_rad), centre.y - radius_px * core::cos(angle_rad)});
  }
  return points;
}

std::vector<Point> triangle(const Point& centre, double radius_px) {
  return star(centre, 3, radius_px, radius_px);
}

std::vector<Point> cross(const Point& centre, double half_px) {
  return {{centre.x - half_px, centre.y - half_px},
          {centre.x + half_px, centre.y + half_px},
          {centre.x - half_px, centre.y + half_px},
          {centre.x + half_px, centre.y - half_px}};
}

void square(SvgWriter& svg, const Point& centre, double half_px, const Paint& paint) {
  svg.rectangle({centre.x - half_px, centre.y - half_px}, 2.0 * half_px, 2.0 * half_px, paint);
}

void trap(SvgWriter& svg, const Point& centre, std::string_view fill, std::string_view outline) {
  svg.polygon(triangle(centre, 9.0), {fill, outline, 1.4});
  svg.line({centre.x, centre.y - 3.5}, {centre.x, centre.y + 0.5}, {"none", outline, 1.6});
  svg.circle({centre.x, centre.y + 3.0}, 0.9, {outline});
}

void crossed_circle(SvgWriter& svg, const Point& centre, std::string_view outline) {
  svg.circle(centre, 5.0, {kWhite, outline, 1.2});
  svg.segments(cross(centre, 2.4), {"none", outline, 1.4});
}

void barred_square(SvgWriter& svg, const Point& centre, std::string_view outline) {
  square(svg, centre, 6.0, {kWhite, outline, 1.6});
  svg.line({centre.x - 6.0, centre.y + 6.0}, {centre.x + 6.0, centre.y - 6.0},
           {"none", outline, 1.6});
}

}  // namespace

std::string_view symbol_name(Symbol symbol) {
  switch (symbol) {
    case Symbol::kLandmarkSom:
      return "landmark known to the SOM";
    case Symbol::kLandmarkArt:
      return "landmark known to ART";
    case Symbol::kTrap:
      return "trap detected";
    case Symbol::kShadowTrap:
      return "trap, by a shadow detector";
    case Symbol::kEarlierVisit:
      return "earlier visit that proves it";
    case Symbol::kEscapeBegun:
      return "escape begun";
    case Symbol::kEscapeEnded:
      return "escape ended, way open";
    case Symbol::kEscapeFailed:
      return "escape failed";
    case Symbol::kVirtualTarget:
      return "virtual target";
    case Symbol::kControllerTarget:
      return "the controller's own virtual target";
    case Symbol::kReflex:
      return "immediate memory acted";
    case Symbol::kSafetyStop:
      return "safety stop";
    case Symbol::kCollision:
      return "collision";
    case Symbol::kHitBy:
      return "hit by a moving obstacle";
    case Symbol::kUnreachable:
      return "called unreachable";
    case Symbol::kEnd:
      break;
  }
  return "end of the run";
}

void draw_symbol(SvgWriter& svg, Symbol symbol, const Point& centre, std::string_view outline) {
  switch (symbol) {
    case Symbol::kLandmarkSom:
      square(svg, centre, 4.2, {"#CBE6F7", kSkyBlue, 1.0});
      return;
    case Symbol::kLandmarkArt:
      svg.polygon(star(centre, 4, 7.0, 7.0), {"#FBE8BF", kOrange, 1.0});
      return;
    case Symbol::kTrap:
      trap(svg, centre, kYellow, outline);
      return;
    case Symbol::kShadowTrap:
      trap(svg, centre, kWhite, kMovingGrey);
      return;
    case Symbol::kEarlierVisit:
      svg.circle(centre, 8.5, {"none", kPurple, 2.4});
      return;
    case Symbol::kEscapeBegun:
      svg.circle(centre, 4.5, {kVermilion, outline, 1.2});
      return;
    case Symbol::kEscapeEnded:
      svg.circle(centre, 4.5, {kGreen, outline, 1.2});
      return;
    case Symbol::kEscapeFailed:
      crossed_circle(svg, centre, outline);
      return;
    case Symbol::kVirtualTarget:
      svg.polygon(star(centre, 10, 6.0, 2.5), {kPurple, outline, 1.0});
      return;
    case Symbol::kControllerTarget:
      svg.circle(centre, 2.0, {kGreen, kWhite, 0.5, "", 0.8});
      return;
    case Symbol::kReflex:
      svg.circle(centre, 2.6, {kPurple, kWhite, 0.8});
      return;
    case Symbol::kSafetyStop:
      svg.segments(cross(centre, 4.5), {"none", kBlack, 2.2});
      return;
    case Symbol::kCollision:
      svg.polygon(star(centre, 16, 9.0, 4.5), {kVermilion, kBlack, 1.2});
      return;
    case Symbol::kHitBy:
      svg.polygon(star(centre, 16, 9.0, 4.5), {kWhite, kBlack, 1.2});
      return;
    case Symbol::kUnreachable:
      barred_square(svg, centre, outline);
      return;
    case Symbol::kEnd:
      svg.circle(centre, 4.0, {kWhite, outline, 2.2});
      return;
  }
}

}  // namespace clew::plot

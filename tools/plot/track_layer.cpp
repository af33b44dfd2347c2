// SPDX-License-Identifier: Apache-2.0
#include "plot/track_layer.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <vector>

#include "plot/palette.hpp"

namespace clew::plot {
namespace {

Symbol symbol_of(domain::EventKind kind) {
  switch (kind) {
    case domain::EventKind::kReflex:
      return Symbol::kReflex;
    case domain::EventKind::kEscapeBegun:
      return Symbol::kEscapeBegun;
    case domain::EventKind::kEscapeEnded:
      return Symbol::kEscapeEnded;
    case domain::EventKind::kEscapeFailed:
      return Symbol::kEscapeFailed;
    case domain::EventKind::kTrap:
      return Symbol::kTrap;
    case domain::EventKind::kLandmark:
      return Symbol::kLandmarkSom;
    case domain::EventKind::kVirtualTarget:
      return Symbol::kVirtualTarget;
    case domain::EventKind::kUnreachable:
      break;
  }
  return Symbol::kUnreachable;
}

Symbol symbol_of(domain::Network network) {
  return network == domain::Network::kSom ? Symbol::kLandmarkSom : Symbol::kLandmarkArt;
}

Symbol symbol_of(const TrapMark& trap) { return trap.shadow ? Symbol::kShadowTrap : Symbol::kTrap; }

/// The least of 1, 2, 5, 10, 20, 50, ... that is no less.
double round_up(double value) {
  double step = 1.0;
  for (int i = 0; step < value; ++i) step *= i % 3 == 1 ? 2.5 : 2.0;
  return step;
}

/// Draws the stretches of the path of ticks in which recovery was at work, or of the others. What
/// was commanded in tick k moves the robot from pose k to pose k + 1.
void draw_stretches(SvgWriter& svg, const MapView& view, const RunTrack& track, bool recovering,
                    const Paint& paint) {
  std::vector<Point> stretch;
  for (std::size_t k = 0; k + 1 < track.poses.size(); ++k) {
    if (track.recovering[k] == recovering) {
      if (stretch.empty()) stretch.push_back(view.at(track.poses[k].position()));
      stretch.push_back(view.at(track.poses[k + 1].position()));
    }
    const bool ends = k + 2 == track.poses.size() || track.recovering[k + 1] != recovering;
    if (ends && !stretch.empty()) {
      svg.polyline(stretch, paint);
      stretch.clear();
    }
  }
}

/// Draws a trap as a sign beside its place, where the escape's beginning and the earlier visit are
/// marked, too.
void draw_trap(SvgWriter& svg, const MapView& view, const TrapMark& trap,
               std::string_view outline) {
  constexpr double kAsidePx = 20.0;
  const Point place = view.at(trap.position);
  const Point sign{place.x + kAsidePx, place.y - kAsidePx};
  svg.line(place, sign, {"none", trap.shadow ? kMovingGrey : outline, 1.2});
  draw_symbol(svg, symbol_of(trap), sign, outline);
}

/// Virtual targets of an escape that sets hundreds would bury the path: then each is a dot.
void draw_virtual_targets(SvgWriter& svg, const MapView& view, const RunTrack& track,
                          std::string_view outline) {
  constexpr std::size_t kMostStars = 24;
  const bool few = track.virtual_targets.size() <= kMostStars;
  for (const VirtualTargetMark& target : track.virtual_targets) {
    const Point at = view.at(target.position);
    if (few) svg.line(view.at(target.from), at, {"none", kPurple, 0.8, "", 0.7});
    if (few) {
      draw_symbol(svg, Symbol::kVirtualTarget, at, outline);
    } else {
      svg.circle(at, 2.0, {kPurple, outline, 0.5, "", 0.8});
    }
  }
}

/// Small marks with the tick's number along the path, at a round number of ticks.
void draw_tick_marks(SvgWriter& svg, const MapView& view, const RunTrack& track,
                     std::string_view colour) {
  constexpr double kMostMarks = 12.0;
  constexpr double kApartPx = 26.0;
  const auto ticks = static_cast<double>(track.poses.size());
  const auto step =
      static_cast<std::size_t>(std::max(1.0, std::ceil(round_up(ticks / kMostMarks))));
  std::vector<Point> labelled;
  for (std::size_t tick = step; tick + 1 < track.poses.size(); tick += step) {
    const Point at = view.at(track.poses[tick].position());
    svg.circle(at, 2.4, {kWhite, colour, 1.4});
    const bool crowded = std::any_of(labelled.begin(), labelled.end(), [&](const Point& other) {
      return std::abs(at.x - other.x) < kApartPx && std::abs(at.y - other.y) < kApartPx / 2.0;
    });
    if (crowded) continue;
    labelled.push_back(at);
    svg.text({at.x + 5.0, at.y - 4.0}, std::to_string(track.first_tick + tick),
             {9.5, Anchor::kStart, colour, false, true});
  }
}

void draw_all(SvgWriter& svg, const MapView& view, const std::vector<core::Vec2>& positions,
              Symbol symbol, std::string_view outline) {
  for (const auto& position : positions) draw_symbol(svg, symbol, view.at(position), outline);
}

}  // namespace

TrackPaint TrackPaint::of(std::size_t run, std::size_t runs) {
  if (runs == 1) {
    return {{"none", kBlue, 2.2}, {"none", kVermilion, 2.8}, false, kBlack};
  }
  // Earlier runs lie below and are broader, so that they show where paths coincide.
  const double width_px = 2.0 + 2.2 * static_cast<double>(runs - 1 - run);
  const std::string_view colour = run_colour(run);
  return {{"none", colour, width_px}, {"none", colour, width_px + 6.0, "", 0.3}, true, colour};
}

TrackPaint TrackPaint::of_robot(std::size_t robot) {
  const std::string_view colour = run_colour(robot);
  return {{"none", colour, 2.2}, {"none", colour, 7.0, "", 0.3}, true, colour};
}

void draw_under_track(SvgWriter& svg, const MapView& view, const RunTrack& track) {
  for (const auto& box : track.virtual_obstacles) {
    std::vector<Point> corners;
    for (const core::Vec2& corner : box) corners.push_back(view.at(corner));
    svg.polygon(corners, kVirtualObstaclePaint);
  }
  if (!track.believed.empty()) {
    std::vector<Point> line;
    for (const core::Vec2& place : track.believed) line.push_back(view.at(place));
    svg.polyline(line, kBelievedPaint);
  }
  for (const core::Vec2& subgoal : track.subgoals) {
    svg.circle(view.at(subgoal), kSubgoalPx, kSubgoalPaint);
  }
  // Diamonds are larger than squares: where both networks know a place, both can be seen.
  for (const auto network : {domain::Network::kFuzzyArt, domain::Network::kSom}) {
    for (const auto& landmark : track.landmarks) {
      if (landmark.network != network) continue;
      draw_symbol(svg, symbol_of(network), view.at(landmark.position), kBlack);
    }
  }
  for (const auto& trap : track.traps) {
    if (!trap.earlier) continue;
    svg.line(view.at(trap.position), view.at(*trap.earlier), {"none", kPurple, 2.0, "5 3"});
  }
}

void draw_track(SvgWriter& svg, const MapView& view, const RunTrack& track,
                const TrackPaint& paint) {
  svg.begin_group(track.name);
  if (paint.recover_is_under) {
    draw_stretches(svg, view, track, true, paint.recover);
    std::vector<Point> whole;
    for (const auto& pose : track.poses) whole.push_back(view.at(pose.position()));
    svg.polyline(whole, paint.seek);
  } else {
    draw_stretches(svg, view, track, false, paint.seek);
    draw_stretches(svg, view, track, true, paint.recover);
  }
  draw_tick_marks(svg, view, track, paint.seek.stroke);
  svg.end_group();
}

void draw_over_track(SvgWriter& svg, const MapView& view, const RunTrack& track,
                     const TrackPaint& paint) {
  for (const auto& trap : track.traps) {
    if (trap.earlier) {
      draw_symbol(svg, Symbol::kEarlierVisit, view.at(*trap.earlier), paint.outline);
    }
    draw_trap(svg, view, trap, paint.outline);
  }
  for (const auto& mark : track.marks) {
    draw_symbol(svg, symbol_of(mark.kind), view.at(mark.position), paint.outline);
  }
  draw_all(svg, view, track.controller_targets, Symbol::kControllerTarget, paint.outline);
  draw_virtual_targets(svg, view, track, paint.outline);
  draw_all(svg, view, track.safety_stops, Symbol::kSafetyStop, paint.outline);
  draw_all(svg, view, track.collisions, Symbol::kCollision, paint.outline);
  draw_all(svg, view, track.hits, Symbol::kHitBy, paint.outline);
  draw_symbol(svg, Symbol::kEnd, view.at(track.poses.back().position()), paint.outline);
}

std::set<Symbol> symbols_of(const RunTrack& track) {
  std::set<Symbol> symbols = {Symbol::kEnd};
  for (const auto& landmark : track.landmarks) symbols.insert(symbol_of(landmark.network));
  for (const auto& mark : track.marks) symbols.insert(symbol_of(mark.kind));
  for (const auto& trap : track.traps) {
    symbols.insert(symbol_of(trap));
    if (trap.earlier) symbols.insert(Symbol::kEarlierVisit);
  }
  if (!track.virtual_targets.empty()) symbols.insert(Symbol::kVirtualTarget);
  if (!track.controller_targets.empty()) symbols.insert(Symbol::kControllerTarget);
  if (!track.safety_stops.empty()) symbols.insert(Symbol::kSafetyStop);
  if (!track.collisions.empty()) symbols.insert(Symbol::kCollision);
  if (!track.hits.empty()) symbols.insert(Symbol::kHitBy);
  return symbols;
}

}  // namespace clew::plot

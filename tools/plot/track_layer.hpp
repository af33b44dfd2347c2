// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string_view>
#include <vector>

#include "plot/map_view.hpp"
#include "plot/palette.hpp"
#include "plot/run_track.hpp"
#include "plot/svg_writer.hpp"
#include "plot/symbols.hpp"

namespace clew::plot {

/// How a run's path is drawn.
struct TrackPaint {
  Paint seek;                ///< on the way to the target
  Paint recover;             ///< while an escape is at work
  bool recover_is_under;     ///< as a broad band under the whole path, not in place of it
  std::string_view outline;  ///< of its marks

  /// For run number `run` of `runs` in one picture: alone, recovery is a colour of its own; among
  /// others each run has its colour, and recovery is a band.
  static TrackPaint of(std::size_t run, std::size_t runs);
  /// For one of several robots of a room, whose paths do not coincide.
  static TrackPaint of_robot(std::size_t robot);
};

inline constexpr Paint kVirtualObstaclePaint{"#F6D9C8", kVermilion, 1.2, "5 3", 0.6};
inline constexpr Paint kBelievedPaint{"none", kMovingGrey, 1.2, "2 3"};
inline constexpr Paint kSubgoalPaint{kSkyBlue, "none", 0.0, "", 0.7};
inline constexpr double kSubgoalPx = 1.8;

/// What lies under the paths: virtual obstacles, the believed path, subgoals, landmarks, and the
/// lines from traps to the visits that prove them.
void draw_under_track(SvgWriter& svg, const MapView& view, const RunTrack& track);
void draw_track(SvgWriter& svg, const MapView& view, const RunTrack& track,
                const TrackPaint& paint);
/// What lies over the paths: traps, escapes, virtual targets, safety stops, collisions, the end.
void draw_over_track(SvgWriter& svg, const MapView& view, const RunTrack& track,
                     const TrackPaint& paint);

/// The symbols that a track's picture contains.
std::set<Symbol> symbols_of(const RunTrack& track);

}  // namespace clew::plot

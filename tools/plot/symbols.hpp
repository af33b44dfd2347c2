// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "plot/palette.hpp"
#include "plot/svg_writer.hpp"

namespace clew::plot {

/// The marks of a picture, the same on the map and in its legend.
enum class Symbol {
  kLandmarkSom,
  kLandmarkArt,
  kTrap,
  kShadowTrap,
  kEarlierVisit,
  kEscapeBegun,
  kEscapeEnded,
  kEscapeFailed,
  kVirtualTarget,
  kControllerTarget,
  kReflex,
  kSafetyStop,
  kCollision,
  kHitBy,
  kUnreachable,
  kEnd
};

/// What the legend calls it.
std::string_view symbol_name(Symbol symbol);

/// Draws a symbol about 12 pixels wide around `centre`; outlines are of `outline`.
void draw_symbol(SvgWriter& svg, Symbol symbol, const Point& centre, std::string_view outline);

}  // namespace clew::plot

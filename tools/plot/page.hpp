// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace clew::plot {

// Where the parts of a picture with a map stand, pixels.
inline constexpr double kMarginPx = 24.0;
inline constexpr double kTitlePx = 56.0;   ///< height of title and details
inline constexpr double kMapPx = 720.0;    ///< the map's longer side
inline constexpr double kFooterPx = 44.0;  ///< height of the scale bar
inline constexpr double kLegendLinePx = 21.0;

}  // namespace clew::plot

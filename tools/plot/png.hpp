// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "core/result.hpp"

namespace clew::plot {

/// Renders an SVG picture to the bytes of a PNG file, two pixels for each of the SVG's.
core::Result<std::string> render_png(std::string_view svg);

}  // namespace clew::plot

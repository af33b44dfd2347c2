// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "core/result.hpp"

namespace clew::plot {

/// Renders an SVG picture to the bytes of a PNG file, two pixels for each of the SVG's.
core::Result<std::string> render_png(std::string_view svg);

/// The same to a PDF file of one page, which stays lines and letters; three quarters of a point for
/// each pixel.
core::Result<std::string> render_pdf(std::string_view svg);

}  // namespace clew::plot

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/result.hpp"

namespace clew::plot {

/// Draws the paths of one or several recordings of runs in the same world into one picture. The end
/// of `output` chooses its kind, `.svg` or `.png`; a file of that name is replaced. The same
/// recordings give the same SVG bytes.
///
/// Refused: another ending, recordings that cannot be read, were made with other message types or
/// hold no state, worlds that differ, and an output that cannot be written. A recording that was
/// cut off is drawn up to the tear, and the picture says so.
core::Result<void> plot_recordings(const std::vector<std::string>& recordings,
                                   const std::string& output);

}  // namespace clew::plot

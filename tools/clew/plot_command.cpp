// SPDX-License-Identifier: Apache-2.0
#include "clew/commands.hpp"
#include "plot/plot.hpp"

namespace clew::tools {

int plot_command(const PlotOptions& options) {
  const auto plotted = plot::plot_recordings(options.recordings, options.output);
  if (!plotted.ok()) return complain(plotted.error());
  return kExitGood;
}

}  // namespace clew::tools

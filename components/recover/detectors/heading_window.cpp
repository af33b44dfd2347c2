// SPDX-License-Identifier: Apache-2.0
#include "recover/detectors/heading_window.hpp"

#include <cmath>

namespace clew::recover {

std::optional<HeadingWindow::Turn> HeadingWindow::add(const Situation& situation,
                                                      double angle_rad) {
  const double heading_rad = situation.pose().heading_rad;
  double turned_rad = 0.0;
  if (!state_.instants.empty()) {
    turned_rad =
        state_.instants.back().turned_rad + core::wrap_angle_rad(heading_rad - state_.heading_rad);
  }
  state_.heading_rad = heading_rad;
  state_.instants.push_back(
      {situation.tick, situation.pose().position(), situation.odometry.travel_m, turned_rad});
  if (state_.instants.size() > ticks_ + 1) state_.instants.pop_front();
  for (const Instant& instant : state_.instants) {
    const double change_rad = turned_rad - instant.turned_rad;
    if (std::fabs(change_rad) > angle_rad) return Turn{instant, change_rad};
  }
  return std::nullopt;
}

}  // namespace clew::recover

// SPDX-License-Identifier: Apache-2.0
#include "control/polar/polar_picture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "control/polar/pose_prediction.hpp"

namespace clew::control {
namespace {

constexpr int kWayParts = 16;

/// A unit's share of the map: half of the way to its neighbours.
domain::PictureCell cell_of(const PolarLattice& lattice, const PolarUnit& unit,
                            const core::Pose2& pose) {
  const double half_rad = core::kPi / static_cast<double>(lattice.sectors());
  const double middle_rad = pose.heading_rad + lattice.bearing_rad(unit.sector);
  const core::Vec2 left = core::direction(middle_rad + half_rad);
  const core::Vec2 right = core::direction(middle_rad - half_rad);
  const double radius_m = lattice.radius_m(unit.ring);
  const double inner_m = std::max(0.0, radius_m - 0.5 * lattice.ring_step_m());
  const double outer_m = radius_m + 0.5 * lattice.ring_step_m();
  const core::Vec2 middle = pose.position();
  return {{middle + inner_m * right, middle + outer_m * right, middle + outer_m * left,
           middle + inner_m * left},
          0.0};
}

/// 0 at the least, 1 at the most; 1 where they are the same.
double share(double value, double least, double most) {
  return most > least ? (value - least) / (most - least) : 1.0;
}

}  // namespace

void draw_landscape(const PolarLandscape& landscape, const core::Pose2& pose_odom_map,
                    domain::Picture& picture) {
  const PolarLattice& lattice = landscape.lattice();
  domain::PictureLayer activation{
      "activation of the map", domain::PictureLayer::Kind::kValues, {}, {}};
  domain::PictureLayer obstructed{"obstructed units", domain::PictureLayer::Kind::kBlocked, {}, {}};
  double least = std::numeric_limits<double>::max();
  double most = std::numeric_limits<double>::lowest();
  for (std::size_t ring = 0; ring < lattice.rings(); ++ring) {
    for (std::size_t sector = 0; sector < lattice.sectors(); ++sector) {
      const PolarUnit unit{ring, sector};
      domain::PictureCell cell = cell_of(lattice, unit, pose_odom_map);
      cell.value = landscape.log_activation(unit);
      if (landscape.obstructed(unit)) {
        obstructed.cells.push_back(cell);
      } else if (std::isfinite(cell.value)) {
        least = std::min(least, cell.value);
        most = std::max(most, cell.value);
        activation.cells.push_back(cell);
      }
    }
  }
  for (domain::PictureCell& cell : activation.cells) cell.value = share(cell.value, least, most);
  for (domain::PictureCell& cell : obstructed.cells) cell.value = 0.0;
  picture.layers.push_back(std::move(activation));
  picture.layers.push_back(std::move(obstructed));
}

void draw_window(const DynamicWindow& window, const core::Pose2& pose_odom_robot, double cycle_s,
                 domain::Picture& picture) {
  domain::PictureChart chart;
  chart.name = "dynamic window";
  chart.x_label = "turn rate, rad/s";
  chart.y_label = "speed, m/s";
  chart.columns = window.turn_rates();
  const auto& cells = window.cells();
  const auto braking = cells.end() - 1;
  const auto [best, worst] = std::minmax_element(
      cells.begin(), braking,
      [](const WindowCell& a, const WindowCell& b) { return a.objective_m < b.objective_m; });
  for (auto cell = cells.begin(); cell != braking; ++cell) {
    chart.cells.push_back({cell->turn_rate_radps, cell->speed_mps,
                           share(-cell->objective_m, -worst->objective_m, -best->objective_m),
                           cell->stops_in_time});
  }
  const WindowCell& chosen = cells[window.chosen()];
  chart.chosen_x = chosen.turn_rate_radps;
  chart.chosen_y = chosen.speed_mps;
  picture.charts.push_back(std::move(chart));

  domain::PictureLayer way{"way to a stop", domain::PictureLayer::Kind::kWay, {}, {}};
  const double lasts_s = window.lasts_s(chosen, cycle_s);
  for (int i = 0; i <= kWayParts; ++i) {
    const double part = static_cast<double>(i) / kWayParts * lasts_s;
    way.places_odom.push_back(
        along_arc(pose_odom_robot, part * chosen.speed_mps, part * chosen.turn_rate_radps)
            .position());
  }
  picture.layers.push_back(std::move(way));
}

}  // namespace clew::control

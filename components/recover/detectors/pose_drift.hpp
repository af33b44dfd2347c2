// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "domain/messages.hpp"

namespace clew::recover {

/// How uncertain odometry was at a visit.
struct PoseDrift {
  double place_m2 = 0.0;      ///< variance of x and y together
  double heading_rad2 = 0.0;  ///< variance

  static PoseDrift of(const domain::Odometry& odometry) {
    const domain::PoseCovariance& c = odometry.covariance;
    return {c.x_m2 + c.y_m2, c.heading_rad2};
  }

  /// Standard deviations of where a visit stands as seen from an earlier one at the same place:
  /// what was added between the two. Exact to first order for noise, since the way between two
  /// visits to one place adds up to nothing, so that the earlier error of the heading has not swung
  /// it (drive/dead_reckoning.hpp: F is the identity then). A variance that has shrunk counts as
  /// none.
  double place_since_m(const PoseDrift& earlier) const {
    return std::sqrt(std::max(0.0, place_m2 - earlier.place_m2));
  }
  double heading_since_rad(const PoseDrift& earlier) const {
    return std::sqrt(std::max(0.0, heading_rad2 - earlier.heading_rad2));
  }
};

template <typename Visitor>
void visit_fields(Visitor& visit, PoseDrift& d) {
  visit(d.place_m2, d.heading_rad2);
}

}  // namespace clew::recover

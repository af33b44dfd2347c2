// SPDX-License-Identifier: Apache-2.0
/// What a detector or an escape in Python gets of a tick, and what an escape asks for. Copies: a
/// behaviour may keep them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "domain/messages.hpp"
#include "recover/situation.hpp"

namespace clew::python {

using Place = std::array<double, 2>;

inline Place place_of(const core::Vec2& point) { return {point.x(), point.y()}; }

struct Situation {
  explicit Situation(const recover::Situation& s)
      : tick(s.tick),
        odometry(s.odometry),
        scan(s.scan),
        target(place_of(s.target_odom)),
        pursued(place_of(s.pursued_odom)),
        target_radius_m(s.target_radius_m),
        target_distance_m(s.target_distance_m()),
        target_bearing_rad(s.target_bearing_rad()) {
    if (s.landmark != nullptr) landmark = *s.landmark;
  }

  std::uint64_t tick;
  domain::Odometry odometry;
  domain::Scan scan;
  std::optional<domain::Landmark> landmark;
  Place target;
  Place pursued;
  double target_radius_m;
  double target_distance_m;
  double target_bearing_rad;
};

/// What an escape asks for in a tick.
struct Request {
  std::optional<Place> target;
  std::optional<domain::Motion> motion;
  std::vector<std::array<double, 4>> obstacles;  ///< x_min, y_min, x_max, y_max
  std::string why;
};

}  // namespace clew::python

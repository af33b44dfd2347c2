// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "domain/messages.hpp"

namespace clew::classify {

/// The spatial classes of Krishna & Kalra 2000, Table I.
inline constexpr std::uint8_t kSpatialClasses = 9;

struct NearnessParameters {
  double near_full_ratio = 0.3;
  double near_none_ratio = 0.7;
  double very_near_degree = 0.9;
  double near_degree = 0.3;
};

/// How near the obstacles on the left, ahead and on the right are: degrees of eq. 4, 0..1.
struct Nearness {
  double left = 0.0;    ///< of min(u_0, u_1, u_2)
  double centre = 0.0;  ///< of u_3
  double right = 0.0;   ///< of min(u_4, u_5, u_6)
};

/// Nearness of a scan of seven beams, leftmost first: Krishna & Kalra 2000, section 3.1.
Nearness nearness(const domain::Scan& scan, const NearnessParameters& parameters);

/// The class of Table I. A reading is very near above very_near_degree, near from near_degree on,
/// else far; very near counts as near but in class 0, where all three are very near.
///
/// The table's columns are right, centre, left. So class 7 is a wall on the left, 4 one on the
/// right, 3 a corridor, 8 is free.
std::uint8_t spatial_class(const Nearness& nearness, const NearnessParameters& parameters);

}  // namespace clew::classify

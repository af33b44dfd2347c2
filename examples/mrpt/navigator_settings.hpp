// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace clew_mrpt {

/// What MRPT's reactive navigation is told. Values that are not here are MRPT's own defaults.
struct NavigatorSettings {
  std::string holonomic;  ///< CHolonomicFullEval or CHolonomicND
  double speed_mps = 0.6;
  double turn_rate_radps = 0.8;
  double radius_m = 0.15;     ///< of the robot, with what is kept free around it
  double look_ahead_m = 4.0;  ///< length of the paths that it weighs
  double path_count = 121;    ///< of a family
};

/// The text of its configuration file.
std::string configuration(const NavigatorSettings& settings);

}  // namespace clew_mrpt

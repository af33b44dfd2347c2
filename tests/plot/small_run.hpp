// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "domain/topics.hpp"
#include "recording/run_description.hpp"

namespace clew::plot_test {

/// A world of 10 m by 8 m with something of every kind in it.
extern const char* const kWorld;

/// Writes the recording of a run of ten ticks of 0.5 s. At tick k the robot stands at (1 + 0.5 k,
/// 2), looking along x; its odometry begins at (0, 0) and has drifted by 0.1 k to the left. Ticks 4
/// to 6 are under recovery. At tick 3 a moving obstacle runs into it. At tick 4 a trap is found,
/// proved by a visit at tick 1, an escape begins and both networks know a landmark; at tick 6 a
/// virtual target is set 2 m ahead of the robot; at tick 7 the escape ends; at tick 8 there is a
/// safety stop; at tick 9 the target is reached.
struct SmallRun {
  bridge::RunDescription description;

  SmallRun();
  /// `finished`: else as a crash leaves it, in `path`.
  void write(const std::string& path, bool finished = true) const;
};

}  // namespace clew::plot_test

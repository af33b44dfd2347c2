// SPDX-License-Identifier: Apache-2.0
/// A motion of any kind as one of another kind. What limits motions and what makes them must agree
/// on what they are, so this is said once.
#pragma once

#include "domain/messages.hpp"

namespace clew::domain {

/// How a robot moves: along its heading, and about itself, counter-clockwise positive.
struct Velocities {
  double speed_mps = 0.0;
  double turn_rate_radps = 0.0;
};

/// The velocities that a motion asks for over a tick of `tick_s`: a turn and a step, each divided
/// by the tick, so that a drive that moves along arcs makes both at once; wheel speeds by Wang,
/// Yang & Meng, eq. 1, with L = `wheel_base_m`. Zero for stopping and giving up.
Velocities to_velocities(const Motion& motion, double tick_s, double wheel_base_m);

/// The turn and step that a motion makes in a tick of `tick_s`; of kind kTurnAndStep, and zero for
/// stopping and giving up.
Motion to_turn_and_step(const Motion& motion, double tick_s, double wheel_base_m);

}  // namespace clew::domain

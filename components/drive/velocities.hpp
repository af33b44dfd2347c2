// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "drive/drive_model.hpp"

namespace clew::drive {

/// Any command as the velocities that it asks for over a tick of tick_s: a turn and a step, each
/// divided by the tick, so that a drive that moves along arcs makes them at once instead of one
/// after the other; wheel speeds by Wang, Yang & Meng, eq. 1, with wheel base wheel_base_m.
Velocities to_velocities(const domain::Motion& motion, double tick_s, double wheel_base_m);

/// One leg of constant velocities.
Legs arc_of(const Velocities& velocities, double tick_s);

}  // namespace clew::drive

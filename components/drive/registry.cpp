// SPDX-License-Identifier: Apache-2.0
#include "drive/registry.hpp"

#include "drive/differential.hpp"
#include "drive/turn_then_step.hpp"
#include "drive/unicycle.hpp"

namespace clew::drive {

runtime::Registry<DriveModel>& drive_models() {
  static runtime::Registry<DriveModel> registry = {
      runtime::registration<DriveModel, TurnThenStep>(
          "turn_then_step", "a turn on the spot, then a straight step (Krishna & Kalra 2000)"),
      runtime::registration<DriveModel, Unicycle>(
          "unicycle",
          "velocities and accelerations within limits (Lagoudakis & Maida 1999, the Nomad 200)"),
      runtime::registration<DriveModel, Differential>(
          "differential", "two driven wheels (Wang, Yang & Meng, eq. 1)"),
  };
  return registry;
}

}  // namespace clew::drive

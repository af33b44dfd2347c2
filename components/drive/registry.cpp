// SPDX-License-Identifier: Apache-2.0
#include "drive/registry.hpp"

#include "drive/turn_then_step.hpp"

namespace clew::drive {

const runtime::Registry<DriveModel>& drive_models() {
  static const runtime::Registry<DriveModel> registry = {
      runtime::registration<DriveModel, TurnThenStep>(
          "turn_then_step", "a turn on the spot, then a straight step (Krishna & Kalra 2000)"),
  };
  return registry;
}

}  // namespace clew::drive

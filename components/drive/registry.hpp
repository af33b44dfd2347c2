// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "drive/drive_model.hpp"
#include "runtime/registry.hpp"

namespace clew::drive {

/// All drive models; those of plug-ins, once they are loaded, stand behind ours.
runtime::Registry<DriveModel>& drive_models();

}  // namespace clew::drive

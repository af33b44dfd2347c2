// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "drive/drive_model.hpp"
#include "runtime/registry.hpp"

namespace clew::drive {

/// All drive models.
const runtime::Registry<DriveModel>& drive_models();

}  // namespace clew::drive

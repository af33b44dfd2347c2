// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "runtime/registry.hpp"
#include "sense/range_sensor.hpp"

namespace clew::sense {

/// All range sensors; those of plug-ins, once they are loaded, stand behind ours.
runtime::Registry<RangeSensor>& sensors();

}  // namespace clew::sense

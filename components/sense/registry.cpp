// SPDX-License-Identifier: Apache-2.0
#include "sense/registry.hpp"

#include "sense/cones.hpp"

namespace clew::sense {

const runtime::Registry<RangeSensor>& sensors() {
  static const runtime::Registry<RangeSensor> registry = {
      runtime::registration<RangeSensor, Cones>(
          "cones", "seven sonar cones of 15 degrees (Krishna & Kalra 2000, section 2)"),
  };
  return registry;
}

}  // namespace clew::sense

// SPDX-License-Identifier: Apache-2.0
#include "sense/registry.hpp"

#include "sense/cones.hpp"
#include "sense/infrared.hpp"
#include "sense/laser.hpp"
#include "sense/sonar_ring.hpp"

namespace clew::sense {

runtime::Registry<RangeSensor>& sensors() {
  static runtime::Registry<RangeSensor> registry = {
      runtime::registration<RangeSensor, Cones>(
          "cones", "seven sonar cones of 15 degrees (Krishna & Kalra 2000, section 2)"),
      runtime::registration<RangeSensor, Laser>(
          "laser", "a laser range finder, 361 rays over 180 degrees (Nakhaeinia et al. 2015)"),
      runtime::registration<RangeSensor, SonarRing>(
          "sonar_ring", "a ring of 16 sonars (Lagoudakis & Maida 1999, the Nomad 200)"),
      runtime::registration<RangeSensor, Infrared>(
          "infrared", "four infrared rangers with 8 bits (Wang, Yang & Meng, eq. 2)"),
  };
  return registry;
}

}  // namespace clew::sense

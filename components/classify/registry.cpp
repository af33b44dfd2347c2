// SPDX-License-Identifier: Apache-2.0
#include "classify/registry.hpp"

#include "classify/krishna_kalra.hpp"
#include "classify/moving_objects.hpp"

namespace clew::classify {

runtime::Registry<Classifier>& classifiers() {
  static runtime::Registry<Classifier> registry = {
      runtime::registration<Classifier, KrishnaKalra>(
          "krishna_kalra",
          "nine spatial classes, SOM and fuzzy ART over their changes (Krishna & Kalra 2000, "
          "section 3)"),
      runtime::registration<Classifier, MovingObjects>(
          "moving_objects",
          "what objects do, by sequences of range patterns (Krishna & Kalra 2000, the outlook)"),
  };
  return registry;
}

}  // namespace clew::classify

// SPDX-License-Identifier: Apache-2.0
#include "classify/registry.hpp"

#include "classify/krishna_kalra.hpp"

namespace clew::classify {

runtime::Registry<Classifier>& classifiers() {
  static runtime::Registry<Classifier> registry = {
      runtime::registration<Classifier, KrishnaKalra>(
          "krishna_kalra",
          "nine spatial classes, SOM and fuzzy ART over their changes (Krishna & Kalra 2000, "
          "section 3)"),
  };
  return registry;
}

}  // namespace clew::classify

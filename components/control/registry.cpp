// SPDX-License-Identifier: Apache-2.0
#include "control/registry.hpp"

#include "control/krishna_kalra_fuzzy.hpp"

namespace clew::control {

const runtime::Registry<Controller>& controllers() {
  static const runtime::Registry<Controller> registry = {
      runtime::registration<Controller, KrishnaKalraFuzzy>(
          "krishna_kalra_fuzzy",
          "fuzzy target attraction and obstacle repulsion (Krishna & Kalra 2000, section 2.1)"),
  };
  return registry;
}

}  // namespace clew::control

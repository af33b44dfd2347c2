// SPDX-License-Identifier: Apache-2.0
#include "control/registry.hpp"

#include "control/attraction/krishna_kalra_fuzzy.hpp"
#include "control/behaviourist/fuzzy_behaviourist.hpp"
#include "control/gaps/nearest_virtual_target.hpp"
#include "control/infrared/infrared_expert.hpp"
#include "control/infrared/neuro_fuzzy.hpp"
#include "control/polar/polar_neural_map.hpp"
#include "control/pursuit/regulated_pure_pursuit.hpp"
#include "control/reactions/give_way.hpp"

namespace clew::control {

runtime::Registry<Controller>& controllers() {
  static runtime::Registry<Controller> registry = {
      runtime::registration<Controller, KrishnaKalraFuzzy>(
          "krishna_kalra_fuzzy",
          "fuzzy target attraction and obstacle repulsion (Krishna & Kalra 2000, section 2.1)"),
      runtime::registration<Controller, NearestVirtualTarget>(
          "nearest_virtual_target",
          "the gap with the shortest path, and 15 fuzzy rules (Nakhaeinia et al. 2015, NVT)"),
      runtime::registration<Controller, FuzzyBehaviourist>(
          "fuzzy_behaviourist",
          "superposed elemental rules (Pin & Bender 1996, the fuzzy behaviourist approach)"),
      runtime::registration<Controller, NeuroFuzzy>(
          "neuro_fuzzy", "four infrared readings through four networks (Wang, Yang & Meng)"),
      runtime::registration<Controller, InfraredExpert>(
          "infrared_expert", "the expert whose opinion trains the networks of neuro_fuzzy"),
      runtime::registration<Controller, PolarNeuralMap>(
          "polar_neural_map",
          "a polar neural map, sonar memory and a dynamic window (Lagoudakis & Maida 1999)"),
      runtime::registration<Controller, RegulatedPurePursuit>(
          "regulated_pure_pursuit",
          "pursues a place on a path, slower where that is due (Macenski et al. 2023)"),
  };
  return registry;
}

runtime::Registry<Reaction>& reactions() {
  static const runtime::TopicSet landmark =
      runtime::TopicSet().set(index_of(domain::Topic::kLandmark));
  static runtime::Registry<Reaction> registry = {
      runtime::registration<Reaction, GiveWay>(
          "give_way",
          "gives way to what moving_objects recognises (the outlook of Krishna & Kalra 2000)",
          landmark),
  };
  return registry;
}

}  // namespace clew::control

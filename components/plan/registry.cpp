// SPDX-License-Identifier: Apache-2.0
#include "plan/registry.hpp"

#include "plan/astar_planner.hpp"
#include "plan/neural_map_planner.hpp"
#include "plan/world_subgoals.hpp"

namespace clew::plan {

runtime::Registry<Planner>& planners() {
  static runtime::Registry<Planner> registry = {
      runtime::registration<Planner, NeuralMapPlanner>(
          "neural_map", "subgoals along the ascent of a neural map (Lagoudakis & Maida 1999)"),
      runtime::registration<Planner, WorldSubgoals>("world_subgoals",
                                                    "the world's own subgoals, in their order"),
      runtime::registration<Planner, AStarPlanner>(
          "astar", "a place to pursue on a path of least cost, by replanning A* (the rival)"),
  };
  return registry;
}

}  // namespace clew::plan

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/run_plan.hpp"

namespace clew::replay_test {

/// One behaviour of one part of one stage.
struct Behaviour {
  std::string stage;
  std::string part;
  std::string name;
};

/// All that are registered, as `clew list` shows them.
std::vector<Behaviour> all_behaviours();

/// The last shipped graph, by name, in which the behaviour fits the others, with it, for
/// `max_ticks`; `graph` itself if it fits there. In the graph's own world if none is named.
std::optional<runtime::RunPlan> plan_with(const Behaviour& behaviour, std::uint64_t max_ticks,
                                          const std::string& world = "",
                                          const std::string& graph = "");

}  // namespace clew::replay_test

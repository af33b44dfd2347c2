// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hunt/candidate.hpp"
#include "runtime/config_source.hpp"

namespace clew::hunt {

/// What the command line says of a space.
struct HuntRequest {
  std::string graph;
  std::optional<std::string> suite;   ///< its worlds
  std::vector<std::string> worlds;    ///< names or paths, with wildcards
  std::vector<std::string> families;  ///< of generated worlds
  std::vector<std::string> with;
  std::vector<std::string> set;  ///< values and ranges
  std::optional<std::string> robot;
  std::optional<std::uint64_t> max_ticks;
  bool moves_start = true;
};

/// Runs of a search end after so many ticks if nobody says otherwise, as in suites.
inline constexpr std::uint64_t kHuntTicks = 6000;

/// The worlds of a request; without suite, worlds and families, all shipped worlds and families of
/// traps that can be solved. The first world is read with the graph, at both ends of every range.
/// Refused: names that nothing has, the same world twice, and what `clew check` refuses.
core::Result<HuntSpace> make_space(const HuntRequest& request, const runtime::ConfigPath& configs,
                                   const std::vector<runtime::StageInfo>& stages);

}  // namespace clew::hunt

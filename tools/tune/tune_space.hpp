// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hunt/case_run.hpp"
#include "hunt/parameter_range.hpp"
#include "runtime/config_source.hpp"

namespace clew::tune {

/// What the command line asks for.
struct TuneRequest {
  std::string graph;
  std::string suite;                    ///< its worlds and seeds
  std::optional<std::string> validate;  ///< a suite to validate on; none: half of the worlds
  std::vector<std::string> with;
  std::vector<std::string> set;  ///< values, and at least one range
  std::optional<std::string> robot;
  std::optional<std::uint64_t> max_ticks;  ///< none: the suite's
};

struct TuneWorld {
  std::string name;
  std::string text;
};

/// Worlds with the seeds with which each is run.
struct TuneWorlds {
  std::vector<TuneWorld> worlds;
  std::vector<std::uint64_t> seeds;

  std::size_t runs() const { return worlds.size() * seeds.size(); }
};

struct TuneSpace {
  hunt::GraphChoice graph;
  std::string graph_digest;  ///< of all that the graph is made of, but its world
  std::vector<hunt::ParameterRange> ranges;
  TuneWorlds tuning;
  TuneWorlds validation;  ///< none of them is a world to tune in
};

/// Reads what is asked for. Without a suite to validate on, every second world of each family is
/// kept for that. Refused: no range, names that nothing has, worlds that are in both suites, too
/// few worlds to keep any, and what `clew check` refuses at either end of the ranges.
core::Result<TuneSpace> make_space(const TuneRequest& request, const runtime::ConfigPath& configs,
                                   const std::vector<runtime::StageInfo>& stages);

}  // namespace clew::tune

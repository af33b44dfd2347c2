// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "bench/grouping.hpp"
#include "core/resources.hpp"
#include "core/result.hpp"

namespace clew::bench {

/// Something of a graph that is given several values in turn: a behaviour (`recover.detector`) or a
/// parameter (`sense.range_m`).
struct Variation {
  struct Value {
    /// More than one where the choice is a list itself, as the fallback order of `recover.escape`.
    std::vector<std::string> words;
    /// Parameters that are set along with a behaviour: names and values.
    std::vector<std::pair<std::string, std::string>> settings = {};
  };

  std::string path;
  std::vector<Value> values;
  /// Where it is asked for, for messages: a suite file's place, or the option.
  std::string file = {};
  int line = 0;
  int column = 0;
};

/// Worlds of trap_worlds: `count` of each family.
struct GeneratedWorlds {
  std::uint64_t seed = 1;
  int count = 0;
  std::vector<std::string> families;
};

/// A world of BARN, which a suite cannot bring along, imported.
struct BarnWorld {
  std::string name;     ///< `barn-N`
  std::string text;     ///< a world file
  double path_m = 0.0;  ///< length of BARN's own path from start to goal
};

/// What a suite file says. Names of graphs and worlds are as written.
struct Suite {
  std::string name;
  std::string about;
  std::vector<std::string> graphs;
  /// What `set` gives every graph comes first, a variation of one value each.
  std::vector<Variation> variations;
  /// Family and its worlds' names or paths, in order, with the wildcards of a shell.
  std::vector<std::pair<std::string, std::vector<std::string>>> worlds;
  GeneratedWorlds generated;
  bool needs_barn = false;      ///< `data: barn`
  std::vector<BarnWorld> barn;  ///< then given besides
  std::vector<std::uint64_t> seeds = {1};
  std::uint64_t max_ticks = 6000;
  /// Tables of the report; empty: by severity, and by family in short.
  std::vector<Grouping> by;
};

/// Reads a suite file, `clew-suite/1`. Refused, with the place and what is allowed: unknown or
/// duplicate keys, unknown families, nothing to run, wrong types, numbers out of range.
core::Result<Suite> read_suite(const core::Resource& file, const std::string& name);

/// Reads the name of a grouping; refused with the names that there are.
core::Result<Grouping> read_grouping(const std::string& name);

/// Reads `PATH=VALUE,VALUE,...` of --vary, where a value `a+b` is the list of a and b.
core::Result<Variation> read_variation(const std::string& text);

}  // namespace clew::bench

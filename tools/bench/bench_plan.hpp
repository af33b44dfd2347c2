// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/suite.hpp"
#include "runtime/config_source.hpp"
#include "runtime/graph.hpp"
#include "runtime/stage.hpp"
#include "trap_worlds/generated_world.hpp"

namespace clew::bench {

/// What the command line changes in a suite.
struct BenchChanges {
  std::vector<std::string> graphs;  ///< in place of the suite's, if any
  std::vector<std::string> with;    ///< for every graph, as in `clew run`
  std::vector<std::string> set;
  std::vector<Variation> variations;  ///< besides the suite's; one of the same path replaces it
};

/// A graph with certain values of what is varied: a row of the report.
struct Variant {
  std::string graph;
  /// Path and value of each variation, in order; one with a single value tells no two apart and is
  /// left out.
  std::vector<std::pair<std::string, std::string>> values;
  runtime::GraphOverrides overrides;

  /// `recover.detector=none recover.escape=none`; empty without variations.
  std::string text() const;
  /// The graph, and the values in brackets.
  std::string label() const;
};

/// A world of the bench: a file's name, an order for a generated one, or an imported one's text.
struct BenchWorld {
  std::string family;
  std::string name;
  std::optional<trap_worlds::WorldOrder> order;
  std::string text = {};  ///< of a world of BARN
  double barn_path_m = 0.0;
};

/// A bench that looks at its results after each batch and ends when they are known well enough.
struct Stopping {
  double width = 0.0;       ///< of the widest anytime_interval of success that is good enough
  std::size_t batches = 0;  ///< that were run
  std::size_t of = 0;       ///< all there are
};

/// All that decides a bench: every variant runs in every world with every seed.
struct BenchPlan {
  std::string suite;
  std::string about;
  std::vector<Variant> variants;
  std::vector<BenchWorld> worlds;
  std::vector<std::uint64_t> seeds;
  /// What the results depend on, named: a bench may be gone on with if this is the same.
  std::map<std::string, std::string> configuration;
  bool coverage = false;  ///< what decided is counted
  /// None: all is run.
  std::optional<Stopping> stopping;
  /// Tables of the report, Suite::by. Results do not depend on it.
  std::vector<Grouping> by;

  std::size_t runs() const { return variants.size() * worlds.size() * seeds.size(); }
};

/// Expands a suite. Every variant is checked as `clew check` does it, in the first world. Refused:
/// names that do not exist, a world twice, variants that do not fit together.
core::Result<BenchPlan> plan_bench(const Suite& suite, const BenchChanges& changes,
                                   const runtime::ConfigPath& configs,
                                   const std::vector<runtime::StageInfo>& stages);

/// The source of a world's runs: the text of a generated one in place of a file.
class WorldSource : public runtime::ConfigSource {
 public:
  WorldSource(const runtime::ConfigSource& configs, const BenchWorld& world);

  core::Result<core::Resource> find(const std::string& folder,
                                    const std::string& name) const override;
  /// The text of a generated or imported world; empty for a file.
  const std::string& generated_text() const { return text_; }
  /// A generated one's depth; none for a file.
  const std::optional<double>& depth_ranges() const { return depth_ranges_; }

 private:
  const runtime::ConfigSource& configs_;
  std::string name_;
  std::string text_;
  std::optional<double> depth_ranges_;
};

}  // namespace clew::bench

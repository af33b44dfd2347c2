// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/bench_plan.hpp"
#include "bench/trap_judge.hpp"
#include "runtime/run_plan.hpp"
#include "world_analysis/clearance_grid.hpp"
#include "world_analysis/severity.hpp"

namespace clew::bench {

/// The runs of a bench in one of its worlds. What is computed of the world, is computed once.
class WorldBench {
 public:
  WorldBench(const BenchPlan& plan, std::size_t world, const runtime::ConfigPath& configs,
             const std::vector<runtime::StageInfo>& stages)
      : plan_(plan), world_(plan.worlds[world]), source_(configs, world_), stages_(stages) {}

  /// Runs a variant, composed, and tells of it as one line of JSON: what `clew run --json` prints,
  /// with `graph`, `variant`, `world`, `family`, `success`, `solvable`, how hard the world is for
  /// this robot and sensor, and what the judge of traps says. None if the run was interrupted by a
  /// signal.
  core::Result<std::optional<std::string>> run(const Variant& variant, std::uint64_t seed);

  /// A generated world's file; empty for another.
  const std::string& generated_text() const { return source_.generated_text(); }

  /// Runs it again with a recording.
  core::Result<void> record(const Variant& variant, std::uint64_t seed, const std::string& path);

 private:
  core::Result<runtime::RunPlan> prepare(const Variant& variant, std::uint64_t seed) const;
  /// What is true of the world for robots of one radius.
  struct Truth {
    world_analysis::TrapMap traps;
    world_analysis::Severity severity;
  };
  /// None where something moves for ever.
  const Truth* truth(const runtime::RunPlan& run);

  const BenchPlan& plan_;
  const BenchWorld& world_;
  WorldSource source_;
  const std::vector<runtime::StageInfo>& stages_;
  std::shared_ptr<const world::World> surveyed_;  ///< what the grid refers to
  std::unique_ptr<world_analysis::ClearanceGrid> grid_;
  std::map<double, Truth> truth_by_radius_;
};

}  // namespace clew::bench

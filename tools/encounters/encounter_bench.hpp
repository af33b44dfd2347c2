// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "encounters/encounters.hpp"
#include "fleet/fleet_run.hpp"
#include "runtime/config_source.hpp"
#include "runtime/stage.hpp"

namespace clew::encounters {

struct EncounterOrder {
  std::vector<Family> families;
  std::vector<int> robots;  ///< how many, one group each
  std::uint32_t count = 1;  ///< encounters of each family and number of robots
  std::uint64_t seed = 1;
  std::string graph = "among_robots";
  unsigned workers = 1;  ///< encounters at a time
  std::function<int()> interrupted = [] { return 0; };
};

/// The encounters of an order, in the order of its families, numbers of robots and counts.
std::vector<Encounter> make_encounters(const EncounterOrder& order);

/// How one encounter went.
struct EncounterResult {
  std::string name;
  Family family = Family::kCrossing;
  int robots = 0;
  int reached = 0;
  int timeouts = 0;
  std::uint64_t contacts = 0;
  double least_gap_m = 0.0;
  double time_s = 0.0;  ///< simulated, until the last robot's end
  std::uint32_t traps = 0;
  core::Hash128 hash;

  bool all_reached() const { return reached == robots; }
};

struct EncounterResults {
  std::vector<EncounterResult> all;  ///< in the order of make_encounters, without those not run
  int interrupted_by = 0;
};

/// Runs them. Refused: a graph that no fleet may have.
core::Result<EncounterResults> run_encounters(const EncounterOrder& order,
                                              const runtime::ConfigSource& files,
                                              const std::vector<runtime::StageInfo>& stages);

/// A line a family and number of robots, in Markdown.
std::string encounter_table(const std::vector<EncounterResult>& results);

/// Writes each encounter as NAME.world.yaml and NAME.yaml, a fleet that names it by its whole path.
/// Refused before anything is written: files that exist, without `force`.
core::Result<void> write_encounters(const EncounterOrder& order, const std::string& folder,
                                    bool force);

}  // namespace clew::encounters

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "clew/command_line.hpp"
#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "clew/json_line.hpp"
#include "core/nearest_name.hpp"
#include "encounters/encounter_bench.hpp"
#include "log/log.hpp"
#include "run/end_signals.hpp"
#include "stages/all.hpp"

namespace clew::tools {
namespace {

using nlohmann::ordered_json;

struct EncountersOptions {
  std::vector<std::string> families = {"crossing", "corridor", "door"};
  std::vector<int> robots = {2, 3, 5, 10, 20};
  std::uint32_t count = 10;
  std::uint64_t seed = 1;
  std::string graph = "among_robots";
  int workers = 1;
  std::string write;
  bool force = false;
  bool json = false;
};

/// Two encounters would have one name.
template <typename Item>
core::Result<void> check_once(const std::vector<Item>& items, const char* option) {
  for (auto item = items.begin(); item != items.end(); ++item) {
    if (std::find(items.begin(), item, *item) == item) continue;
    return core::Error{fmt::format("found {} twice; allowed: each once", *item), option};
  }
  return {};
}

core::Result<encounters::EncounterOrder> order_of(const EncountersOptions& options) {
  CLEW_RETURN_IF_ERROR(check_once(options.families, "--families"));
  CLEW_RETURN_IF_ERROR(check_once(options.robots, "--robots"));
  encounters::EncounterOrder order;
  const auto& names = encounters::family_names();
  for (const std::string& family : options.families) {
    const auto found = std::find(names.begin(), names.end(), family);
    if (found == names.end()) {
      return core::Error{core::unknown_name("family", family, names), "--families"};
    }
    order.families.push_back(static_cast<encounters::Family>(found - names.begin()));
  }
  order.robots = options.robots;
  order.count = options.count;
  order.seed = options.seed;
  order.graph = options.graph;
  order.workers = static_cast<unsigned>(options.workers);
  return order;
}

ordered_json json_of(const encounters::EncounterResult& result) {
  return {{"encounter", result.name},
          {"family", encounters::family_names()[static_cast<std::size_t>(result.family)]},
          {"robots", result.robots},
          {"reached", result.reached},
          {"timeouts", result.timeouts},
          {"contacts", result.contacts},
          {"least_gap_m", result.least_gap_m},
          {"traps", result.traps},
          {"time_s", result.time_s},
          {"hash", result.hash.hex()}};
}

int encounters_command(const EncountersOptions& options) {
  auto order = order_of(options);
  if (!order.ok()) return complain(order.error());
  if (options.force && options.write.empty()) {
    return complain({"needs --write DIR", "--force", 0, 0});
  }
  if (!options.write.empty()) {
    const auto written = encounters::write_encounters(*order, options.write, options.force);
    return written.ok() ? kExitGood : complain(written.error());
  }
  bridge::EndSignals signals;
  order->interrupted = [&signals] { return signals.take(); };
  const auto results =
      encounters::run_encounters(*order, runtime::ConfigPath::from_environment(), stages::all());
  if (!results.ok()) return complain(results.error());
  std::size_t reached = 0;
  for (const auto& result : results->all) {
    if (result.all_reached()) ++reached;
    if (options.json) fmt::print("{}\n", json_line(json_of(result)));
  }
  if (!options.json) {
    fmt::print("{}\n{} of {} encounters: all robots reached their targets\n",
               encounters::encounter_table(results->all), reached, results->all.size());
  }
  if (results->interrupted_by == 0) return kExitGood;
  logs::info("interrupted; encounters that had not ended are left out");
  return kExitInterrupted;
}

}  // namespace

void add_encounters(CLI::App& main, int& status) {
  const auto options = std::make_shared<EncountersOptions>();
  CLI::App* app = main.add_subcommand(
      "encounters", "Bench robots that meet: generated crossings, corridors and doors");
  app->add_option("--families", options->families, "crossing, corridor, door (all)")
      ->delimiter(',');
  app->add_option("--robots", options->robots, "how many, 2 to 20 each (2,3,5,10,20)")
      ->delimiter(',')
      ->check(number_between(encounters::kLeastRobots, encounters::kMostRobots));
  app->add_option("--count", options->count, "encounters of each family and number of robots (10)")
      ->check(number_between(1, 10000));
  app->add_option("--seed", options->seed, "of the encounters and the runs (1)");
  app->add_option("--graph", options->graph, "of each robot (among_robots)");
  app->add_option("--workers", options->workers, "encounters at a time (1)")
      ->check(number_between(1, 64));
  app->add_option("--write", options->write,
                  "run nothing, and write the encounters as fleets and worlds into a folder");
  app->add_flag("--force", options->force, "overwrite those files");
  app->add_flag("--json", options->json, "print each encounter as one JSON object");
  app->callback([options, &status] { status = encounters_command(*options); });
}

}  // namespace clew::tools

// SPDX-License-Identifier: Apache-2.0
#include "encounters/encounter_bench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <optional>

#include "fleet/fleet_plan.hpp"
#include "fleet/tick_crew.hpp"

namespace clew::encounters {
namespace {

using core::Result;

/// Files, and the world of one encounter.
class EncounterSource : public runtime::ConfigSource {
 public:
  EncounterSource(const runtime::ConfigSource& files, const Encounter& encounter)
      : files_(files), encounter_(encounter) {}

  Result<core::Resource> find(const std::string& folder, const std::string& name) const override {
    if (folder == "worlds" && name == encounter_.name) {
      return core::Resource{encounter_.name + ".world.yaml", encounter_.world};
    }
    return files_.find(folder, name);
  }

 private:
  const runtime::ConfigSource& files_;
  const Encounter& encounter_;
};

EncounterResult result_of(const Encounter& encounter, const fleet::FleetReport& report) {
  EncounterResult result;
  result.name = encounter.name;
  result.family = encounter.family;
  result.robots = static_cast<int>(report.robots.size());
  for (const fleet::RobotReport& robot : report.robots) {
    const auto& truth = robot.statistics.truth;
    if (!truth) continue;
    if (truth->outcome == domain::Outcome::kReached) ++result.reached;
    if (truth->outcome == domain::Outcome::kTimeout) ++result.timeouts;
    result.traps += robot.statistics.traps_detected;
  }
  result.contacts = report.contacts;
  result.least_gap_m = report.least_gap_m;
  result.time_s = report.sim_time_s;
  result.hash = report.hash;
  return result;
}

}  // namespace

std::vector<Encounter> make_encounters(const EncounterOrder& order) {
  std::vector<Encounter> encounters;
  for (const Family family : order.families) {
    for (const int robots : order.robots) {
      for (std::uint32_t number = 0; number < order.count; ++number) {
        encounters.push_back(make_encounter(family, robots, number, order.seed, order.graph));
      }
    }
  }
  return encounters;
}

Result<EncounterResults> run_encounters(const EncounterOrder& order,
                                        const runtime::ConfigSource& files,
                                        const std::vector<runtime::StageInfo>& stages) {
  const auto encounters = make_encounters(order);
  std::vector<std::optional<EncounterResult>> results(encounters.size());
  std::vector<core::Error> errors(encounters.size());
  std::atomic<int> signal{0};
  fleet::FleetOptions options;
  options.interrupted = [&] {
    if (const int taken = order.interrupted(); taken != 0) signal = taken;
    return signal.load();
  };
  fleet::TickCrew crew(order.workers);
  crew.each(encounters.size(), [&](std::size_t i) {
    if (signal != 0) return;
    const EncounterSource source(files, encounters[i]);
    const auto plan = fleet::FleetPlan::prepare(encounters[i].fleet, {}, source, stages);
    if (!plan.ok()) {
      errors[i] = plan.error();
      return;
    }
    const auto report = fleet::run_fleet(*plan, options);
    if (!report.ok()) {
      errors[i] = report.error();
    } else if (report->aborted.empty()) {
      results[i] = result_of(encounters[i], *report);
    }
  });
  for (const core::Error& error : errors) {
    if (!error.message.empty()) return error;
  }
  EncounterResults done;
  for (auto& result : results) {
    if (result) done.all.push_back(std::move(*result));
  }
  done.interrupted_by = signal;
  return done;
}

std::string encounter_table(const std::vector<EncounterResult>& results) {
  std::string text =
      "| encounter | robots | encounters | all reached | robots reached | timeouts | contacts | "
      "least gap (m) | traps | time (s), median |\n|---|---|---|---|---|---|---|---|---|---|\n";
  for (std::size_t begin = 0; begin < results.size();) {
    std::size_t end = begin;
    int all = 0;
    int reached = 0;
    int timeouts = 0;
    std::uint64_t contacts = 0;
    std::uint64_t traps = 0;
    double gap_m = results[begin].least_gap_m;
    std::vector<double> times_s;
    for (; end < results.size() && results[end].family == results[begin].family &&
           results[end].robots == results[begin].robots;
         ++end) {
      const EncounterResult& result = results[end];
      if (result.all_reached()) ++all;
      reached += result.reached;
      timeouts += result.timeouts;
      contacts += result.contacts;
      traps += result.traps;
      gap_m = std::min(gap_m, result.least_gap_m);
      times_s.push_back(result.time_s);
    }
    std::sort(times_s.begin(), times_s.end());
    const auto count = end - begin;
    text += fmt::format("| {} | {} | {} | {} | {} of {} | {} | {} | {:.3f} | {} | {:.1f} |\n",
                        family_names()[static_cast<std::size_t>(results[begin].family)],
                        results[begin].robots, count, all, reached,
                        count * static_cast<std::size_t>(results[begin].robots), timeouts, contacts,
                        gap_m, traps, times_s[count / 2]);
    begin = end;
  }
  return text;
}

}  // namespace clew::encounters

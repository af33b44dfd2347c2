// SPDX-License-Identifier: Apache-2.0
#include "contract/behaviour_contract.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>

#include "contract/mission.hpp"
#include "core/random.hpp"
#include "stages/all.hpp"

namespace clew::contract {
namespace {

using core::Error;
using core::Result;

constexpr char kFullestGraph[] = "krishna_kalra";
constexpr char kWorld[] = "kk-fig12-hooks";  // with a trap, where all parts get to work
constexpr int kTicks = 500;
// A break every 29 ticks falls into seeking, turning about and following.
constexpr int kTicksBetweenBreaks = 29;
constexpr int kBadTicks = 120;
constexpr int kRangeTicks = 40;

Error broken(const std::string& what) { return {what}; }

const runtime::VariantInfo* find_variant(const runtime::BehaviourName& behaviour) {
  for (const runtime::StageInfo& stage : stages::all()) {
    if (stage.name != behaviour.stage) continue;
    for (const runtime::PartInfo& part : stage.parts) {
      if (part.name != behaviour.part) continue;
      if (const auto* variant = part.find(behaviour.name)) return variant;
    }
  }
  return nullptr;
}

// With errors of the sensor and of odometry, so that random numbers are at work as well. A sensor
// of someone else's may have none.
std::vector<std::string> noise(const Subject& subject) {
  const std::string name = "noise_stddev_m";
  std::vector<std::string> set = {"drive.drift_rad_per_sqrt_m=0.01"};
  bool has_noise = subject.behaviour.stage != "sense";
  if (const auto* variant = find_variant(subject.behaviour); variant != nullptr && !has_noise) {
    has_noise = std::any_of(variant->parameters.begin(), variant->parameters.end(),
                            [&](const core::ParameterInfo& info) { return info.name == name; });
  }
  if (has_noise) set.push_back("sense." + name + "=0.01");
  return set;
}

Result<void> check_samples(const Mission& run, int tick) {
  for (const domain::Topic topic : domain::kAllTopics) {
    if (!run.topics()[domain::index_of(topic)]) continue;
    const auto valid = domain::visit_topic(topic, [&](auto constant) {
      return domain::validate(std::get<decltype(constant)::kIndex>(run.messages()));
    });
    if (!valid.ok()) return broken(fmt::format("tick {}: {}", tick, valid.error().text()));
  }
  return {};
}

Result<void> run_valid(Mission& run, int ticks, const Mission::Disturb& disturb = nullptr) {
  for (int tick = 0; tick < ticks && !run.over(); ++tick) {
    run.step(disturb);
    CLEW_RETURN_IF_ERROR(check_samples(run, tick));
  }
  return {};
}

struct BadScan {
  const char* what;
  std::function<void(std::size_t beam, domain::Scan&)> change;
};

const std::vector<BadScan>& bad_scans() {
  static const std::vector<BadScan> all = {
      {"every range is 0", [](std::size_t i, domain::Scan& s) { s.ranges_m[i] = 0.0; }},
      {"nothing is in range",
       [](std::size_t i, domain::Scan& s) { s.ranges_m[i] = s.range_max_m; }},
      {"every other beam is blind",
       [](std::size_t i, domain::Scan& s) { s.ranges_m[i] = i % 2 == 0 ? 0.0 : s.range_max_m; }},
      {"all ranges are equal",
       [](std::size_t i, domain::Scan& s) { s.ranges_m[i] = 0.5 * s.range_max_m; }}};
  return all;
}

/// The values to try of a parameter: the ends of its range, as --set takes them.
std::vector<std::string> ends_of(const core::ParameterInfo& info) {
  if (!info.range) return {};
  if (std::holds_alternative<std::int64_t>(info.default_value)) {
    // Capacities may be huge, which is a matter of memory and not of the rule.
    return {fmt::format("{}", static_cast<std::int64_t>(info.range->min)),
            fmt::format("{}", static_cast<std::int64_t>(std::min(info.range->max, 1e5)))};
  }
  return {fmt::format("{}", info.range->min), fmt::format("{}", info.range->max)};
}

std::string path_of(const Subject& subject, const std::string& parameter) {
  const auto& behaviour = subject.behaviour;
  if (behaviour.part == "behaviour") return behaviour.stage + '.' + parameter;
  return fmt::format("{}.{}.{}.{}", behaviour.stage, behaviour.part, behaviour.name, parameter);
}

}  // namespace

Result<Mission> mission(const Subject& subject) {
  runtime::GraphOverrides overrides;
  overrides.world = kWorld;
  overrides.with = {subject.choice()};
  overrides.set = noise(subject);
  overrides.robot_index = 1;  // robot 0 gives way to nobody
  auto plan = runtime::prepare_run(subject.graph, overrides, *subject.configs, stages::all());
  if (!plan.ok()) return plan.error();
  return Mission::create(std::move(plan).value());
}

Result<Subject> find_graph(const runtime::BehaviourName& behaviour,
                           const runtime::ConfigPath& configs) {
  std::vector<std::string> graphs = configs.names("graphs");
  graphs.insert(graphs.begin(), kFullestGraph);
  std::optional<Error> first;
  for (const std::string& graph : graphs) {
    Subject subject{behaviour, graph, &configs};
    auto run = Mission::create(configs, graph, kWorld, {subject.choice()}, {});
    if (run.ok()) return subject;
    if (!first) first = run.error();
  }
  return broken("fits in no shipped graph: " + first->text());
}

Result<void> check_declarations(const Subject& subject) {
  const runtime::VariantInfo* variant = find_variant(subject.behaviour);
  if (variant == nullptr) return broken("is not listed");
  if (variant->summary.empty()) return broken("has no summary");
  for (const core::ParameterInfo& info : variant->parameters) {
    if (info.doc.empty()) return broken("parameter " + info.name + " has no description");
    const double* number = std::get_if<double>(&info.default_value);
    if (number == nullptr) continue;
    if (!info.range) return broken("parameter " + info.name + " has no range");
    if (info.unit.empty()) {
      return broken("parameter " + info.name + " has no unit; 1 is that of a pure number");
    }
    if (*number < info.range->min || *number > info.range->max) {
      return broken(fmt::format("the default of {} is {}, its range {} to {}", info.name, *number,
                                info.range->min, info.range->max));
    }
  }
  return {};
}

Result<void> check_determinism(const Subject& subject) {
  auto first = mission(subject);
  if (!first.ok()) return first.error();
  auto second = mission(subject);
  if (!second.ok()) return second.error();
  for (int tick = 0; tick < kTicks && !first->over(); ++tick) {
    first->step();
    second->step();
    if (first->digest() != second->digest()) {
      return broken(fmt::format("two runs differ at tick {}", tick));
    }
  }
  return {};
}

Result<void> check_save_and_load(const Subject& subject) {
  auto uninterrupted = mission(subject);
  if (!uninterrupted.ok()) return uninterrupted.error();
  std::vector<std::string> digests;
  std::vector<Mission::Saved> breaks;
  for (int tick = 0; tick < kTicks && !uninterrupted->over(); ++tick) {
    if (tick % kTicksBetweenBreaks == 0) breaks.push_back(uninterrupted->save());
    uninterrupted->step();
    digests.push_back(uninterrupted->digest());
  }
  // From one break to the next: what is saved there must be the same as without the break before
  // it.
  for (std::size_t i = 0; i < breaks.size(); ++i) {
    const Mission::Saved& saved = breaks[i];
    const bool is_last = i + 1 == breaks.size();
    const std::uint64_t end = is_last ? digests.size() : breaks[i + 1].next_tick;
    auto restored = mission(subject);
    if (!restored.ok()) return restored.error();
    const auto loaded = restored->load(saved);
    if (!loaded.ok()) {
      return broken(
          fmt::format("saved before tick {}: {}", saved.next_tick, loaded.error().text()));
    }
    for (std::uint64_t tick = saved.next_tick; tick < end; ++tick) {
      restored->step();
      if (restored->digest() == digests[tick]) continue;
      return broken(
          fmt::format("saved and loaded before tick {}, it does something else at tick {}",
                      saved.next_tick, tick));
    }
    if (!is_last && restored->save().nodes != breaks[i + 1].nodes) {
      return broken(
          fmt::format("saved and loaded before tick {}, it saves something else at tick {}",
                      saved.next_tick, end));
    }
  }
  return {};
}

Result<void> check_bounds(const Subject& subject) {
  auto run = mission(subject);
  if (!run.ok()) return run.error();
  return run_valid(*run, kTicks);
}

Result<void> check_bad_scans(const Subject& subject) {
  for (const BadScan& bad : bad_scans()) {
    auto run = mission(subject);
    if (!run.ok()) return run.error();
    const auto valid = run_valid(*run, kBadTicks, [&](domain::Scan& scan) {
      for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) bad.change(i, scan);
    });
    if (!valid.ok()) return broken(std::string(bad.what) + ": " + valid.error().text());
  }
  return {};
}

Result<void> check_parameter_ranges(const Subject& subject) {
  const runtime::VariantInfo* variant = find_variant(subject.behaviour);
  if (variant == nullptr) return broken("is not listed");
  for (const core::ParameterInfo& info : variant->parameters) {
    for (const std::string& value : ends_of(info)) {
      auto run = Mission::create(*subject.configs, subject.graph, kWorld, {subject.choice()},
                                 {path_of(subject, info.name) + '=' + value});
      if (!run.ok()) continue;  // a refusal is an answer
      const auto valid = run_valid(*run, kRangeTicks);
      if (!valid.ok()) return broken(info.name + " = " + value + ": " + valid.error().text());
    }
  }
  return {};
}

const std::vector<Rule>& rules() {
  static const std::vector<Rule> all = {
      {"declarations", "summary, and documents, units and ranges of parameters",
       check_declarations},
      {"determinism", "the same inputs give the same samples", check_determinism},
      {"save_and_load", "saved and loaded at any tick, it goes on as before", check_save_and_load},
      {"bounds", "all samples keep the rules of their fields", check_bounds},
      {"bad_scans", "also with the scans of a broken sensor", check_bad_scans},
      {"parameter_ranges", "at both ends of each range it works or is refused",
       check_parameter_ranges},
      {"insides", "what it tells of its inside is sound, and asking changes nothing",
       check_insides}};
  return all;
}

}  // namespace clew::contract

// SPDX-License-Identifier: Apache-2.0
#include "bench/bench_plan.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/world_names.hpp"
#include "core/hash128.hpp"
#include "core/nearest_name.hpp"
#include "runtime/run_plan.hpp"

namespace clew::bench {
namespace {

using core::Error;
using core::Result;
using runtime::StageInfo;

std::string joined(const std::vector<std::string>& words, const char* separator) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : separator) + word;
  return text;
}

/// Whether a path names a behaviour, to be chosen by `with`, and not a parameter.
bool names_a_behaviour(const std::string& path, const std::vector<StageInfo>& stages) {
  const std::size_t dot = path.find('.');
  if (dot == std::string::npos) return true;
  for (const StageInfo& stage : stages) {
    if (stage.name != path.substr(0, dot)) continue;
    return std::any_of(stage.parts.begin(), stage.parts.end(),
                       [&](const auto& part) { return part.name == path.substr(dot + 1); });
  }
  return false;
}

/// A value as labels have it: `laser(range_m=4)`.
std::string value_text(const Variation::Value& value) {
  if (value.settings.empty()) return joined(value.words, "+");
  std::vector<std::string> words;
  for (const auto& [name, setting] : value.settings) words.push_back(name + '=' + setting);
  return value.words.front() + '(' + joined(words, ", ") + ')';
}

void apply(const std::string& path, const Variation::Value& value,
           const std::vector<StageInfo>& stages, runtime::GraphOverrides& overrides) {
  const auto& words = value.words;
  if (!names_a_behaviour(path, stages)) {
    const std::string text = words.size() == 1 ? words[0] : '[' + joined(words, ", ") + ']';
    overrides.set.push_back(path + '=' + text);
    return;
  }
  overrides.with.push_back(path + '=' + joined(words, ","));
  // Parameters of a stage's behaviour are the stage's; those of a part's are under its name.
  const bool is_part = path.find('.') != std::string::npos;
  const std::string owner = is_part ? path + '.' + words.front() : path;
  for (const auto& [name, setting] : value.settings) {
    overrides.set.push_back(owner + '.' + name + '=' + setting);
  }
}

/// Every graph with every combination of values; the last variation changes fastest.
std::vector<Variant> combine(const std::vector<std::string>& graphs,
                             const std::vector<Variation>& variations, const Suite& suite,
                             const BenchChanges& changes, const std::vector<StageInfo>& stages) {
  std::vector<Variant> variants;
  for (const std::string& graph : graphs) {
    Variant variant{graph, {}, {}};
    variant.overrides.with = changes.with;
    variant.overrides.set = changes.set;
    variant.overrides.max_ticks = suite.max_ticks;
    variants.push_back(std::move(variant));
  }
  for (const Variation& variation : variations) {
    std::vector<Variant> more;
    for (const Variant& variant : variants) {
      for (const auto& value : variation.values) {
        more.push_back(variant);
        apply(variation.path, value, stages, more.back().overrides);
        if (variation.values.size() == 1) continue;
        more.back().values.emplace_back(variation.path, value_text(value));
      }
    }
    variants = std::move(more);
  }
  return variants;
}

/// Whether --with or --set gives `path` a value.
bool is_given(const std::string& path, const BenchChanges& changes) {
  for (const auto& texts : {changes.with, changes.set}) {
    for (const std::string& text : texts) {
      if (text.substr(0, text.find('=')) == path) return true;
    }
  }
  return false;
}

/// The suite's variations and those of the command line, which outranks it.
std::vector<Variation> all_variations(const Suite& suite, const BenchChanges& changes) {
  std::vector<Variation> all;
  for (const Variation& variation : suite.variations) {
    if (variation.values.size() > 1 || !is_given(variation.path, changes)) all.push_back(variation);
  }
  for (const Variation& change : changes.variations) {
    const auto same = std::find_if(all.begin(), all.end(), [&](const Variation& variation) {
      return variation.path == change.path;
    });
    if (same == all.end()) {
      all.push_back(change);
    } else {
      *same = change;
    }
  }
  return all;
}

Result<void> add_world(BenchPlan& plan, BenchWorld world) {
  for (const BenchWorld& other : plan.worlds) {
    if (other.name == world.name) {
      return Error{"world '" + world.name + "' stands twice in the suite", plan.suite};
    }
  }
  plan.worlds.push_back(std::move(world));
  return {};
}

Result<void> add_files(const std::string& family, const std::string& pattern,
                       const runtime::ConfigPath& configs, BenchPlan& plan) {
  const auto names = world_names(pattern, configs);
  if (!names.ok()) return Error{names.error().message, plan.suite};
  for (const std::string& name : *names) CLEW_RETURN_IF_ERROR(add_world(plan, {family, name, {}}));
  return {};
}

Result<void> add_worlds(const Suite& suite, const runtime::ConfigPath& configs, BenchPlan& plan) {
  for (const auto& [family, patterns] : suite.worlds) {
    for (const std::string& pattern : patterns) {
      CLEW_RETURN_IF_ERROR(add_files(family, pattern, configs, plan));
    }
  }
  for (const std::string& name : suite.generated.families) {
    const auto& families = trap_worlds::families();
    const auto family = std::find_if(families.begin(), families.end(),
                                     [&](const auto& candidate) { return candidate.name == name; });
    for (int number = 0; number < suite.generated.count; ++number) {
      trap_worlds::WorldOrder order;
      order.family = &*family;
      order.seed = suite.generated.seed;
      order.number = number;
      order.count = suite.generated.count;
      CLEW_RETURN_IF_ERROR(add_world(plan, {name, trap_worlds::world_name(order), order}));
    }
  }
  for (const BarnWorld& world : suite.barn) {
    CLEW_RETURN_IF_ERROR(add_world(plan, {"barn", world.name, {}, world.text, world.path_m}));
  }
  if (plan.worlds.empty()) {
    return Error{
        "needs the worlds of BARN, which are not part of it: a directory with world_N.world "
        "and path_N.npy (--data of bench)",
        plan.suite};
  }
  return {};
}

/// Whether an error is in an override of this path, or of a parameter under it.
bool is_of(const std::string& place, const std::string& path) {
  for (const std::string option : {"--with ", "--set "}) {
    const std::string beginning = option + path;
    if (place == beginning || place.compare(0, beginning.size() + 1, beginning + '.') == 0) {
      return true;
    }
  }
  return false;
}

/// An error in an override that a variation made is that variation's.
Error at_variation(Error error, const std::vector<Variation>& variations) {
  for (const Variation& variation : variations) {
    if (!is_of(error.file, variation.path)) continue;
    return {error.message, variation.file, variation.line, variation.column};
  }
  return error;
}

/// Checks a variant and notes what it is made of.
Result<void> check_variant(const Variant& variant, const std::vector<Variation>& variations,
                           const WorldSource& source, const std::vector<StageInfo>& stages,
                           BenchPlan& plan) {
  runtime::GraphOverrides overrides = variant.overrides;
  overrides.world = plan.worlds.front().name;
  const auto run = runtime::prepare_run(variant.graph, overrides, source, stages);
  if (!run.ok()) {
    Error error = at_variation(run.error(), variations);
    if (!variant.values.empty()) error.message = variant.label() + ": " + error.message;
    return error;
  }
  for (const runtime::GraphStage& stage : run->graph.stages) {
    if (!stage.deployment.ros2) continue;
    return stage.place.error(
        stage.info->name +
        " has ros2: a robot runs once, in real time; a bench takes graphs whose "
        "robot is simulated");
  }
  std::string content;
  for (const auto& [name, text] : run->bundle) {
    if (name != "world.yaml") content += name + '\n' + text + '\n';
  }
  plan.configuration["graph " + variant.label()] = core::hash128(content).hex();
  return {};
}

/// One world by two names would be two samples.
Result<void> check_is_another(const BenchPlan& plan, const BenchWorld& world,
                              const std::string& content) {
  for (const BenchWorld& other : plan.worlds) {
    const auto noted = plan.configuration.find("world " + other.name);
    const bool same = noted != plan.configuration.end() && noted->second == content;
    if (!same || other.name == world.name) continue;
    return Error{
        fmt::format("'{}' and '{}' are the same world: once is allowed", other.name, world.name),
        plan.suite};
  }
  return {};
}

Result<void> note_worlds(const Suite& suite, const runtime::ConfigPath& configs, BenchPlan& plan) {
  for (const BenchWorld& world : plan.worlds) {
    std::string& content = plan.configuration["world " + world.name];
    if (world.order) {
      content = fmt::format("generated: seed {}, {} of {}", suite.generated.seed,
                            world.order->number + 1, world.order->count);
      continue;
    }
    const auto file = WorldSource(configs, world).find("worlds", world.name);
    if (!file.ok()) return file.error();
    content = core::hash128(file->text).hex();
    if (world.barn_path_m > 0.0) content += fmt::format(", path {} m", world.barn_path_m);
    CLEW_RETURN_IF_ERROR(check_is_another(plan, world, content));
  }
  return {};
}

/// `1 2 5`, or `1 to 1000` where many follow on each other.
std::string seeds_text(const std::vector<std::uint64_t>& seeds) {
  constexpr std::size_t kMany = 10;
  const bool is_range =
      std::adjacent_find(seeds.begin(), seeds.end(), [](std::uint64_t a, std::uint64_t b) {
        return b != a + 1;
      }) == seeds.end();
  if (is_range && seeds.size() > kMany) return fmt::format("{} to {}", seeds.front(), seeds.back());
  return fmt::format("{}", fmt::join(seeds, " "));
}

}  // namespace

std::string Variant::text() const {
  std::string text;
  for (const auto& [path, value] : values) {
    text += (text.empty() ? "" : " ") + path + '=' + value;
  }
  return text;
}

std::string Variant::label() const { return values.empty() ? graph : graph + " [" + text() + ']'; }

WorldSource::WorldSource(const runtime::ConfigSource& configs, const BenchWorld& world)
    : configs_(configs), name_(world.name), text_(world.text) {
  if (!world.order) return;
  const auto generated = trap_worlds::generate_world(*world.order);
  text_ = generated.text;
  depth_ranges_ = generated.depth_ranges;
}

Result<core::Resource> WorldSource::find(const std::string& folder, const std::string& name) const {
  if (folder == "worlds" && name == name_ && !text_.empty()) {
    return core::Resource{name + (depth_ranges_ ? " (generated)" : " (imported)"), text_};
  }
  return configs_.find(folder, name);
}

Result<BenchPlan> plan_bench(const Suite& suite, const BenchChanges& changes,
                             const runtime::ConfigPath& configs,
                             const std::vector<StageInfo>& stages) {
  BenchPlan plan;
  plan.suite = suite.name;
  plan.about = suite.about;
  plan.seeds = suite.seeds;
  plan.by = suite.by;
  const std::vector<Variation> variations = all_variations(suite, changes);
  plan.variants = combine(changes.graphs.empty() ? suite.graphs : changes.graphs, variations, suite,
                          changes, stages);
  CLEW_RETURN_IF_ERROR(add_worlds(suite, configs, plan));
  CLEW_RETURN_IF_ERROR(note_worlds(suite, configs, plan));
  const WorldSource source(configs, plan.worlds.front());
  for (const Variant& variant : plan.variants) {
    if (plan.configuration.count("graph " + variant.label()) > 0) {
      return Error{"'" + variant.label() + "' is asked for twice", plan.suite};
    }
    CLEW_RETURN_IF_ERROR(check_variant(variant, variations, source, stages, plan));
  }
  plan.configuration["max_ticks"] = std::to_string(suite.max_ticks);
  plan.configuration["seeds"] = seeds_text(suite.seeds);
  plan.configuration["suite"] = suite.name;
  return plan;
}

}  // namespace clew::bench

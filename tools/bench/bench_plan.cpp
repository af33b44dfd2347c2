// SPDX-License-Identifier: Apache-2.0
#include "bench/bench_plan.hpp"

#include <fmt/format.h>

#include <algorithm>

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
std::string value_text(const Variation& variation, const std::vector<std::string>& value) {
  const auto settings = variation.settings.find(value.front());
  if (settings == variation.settings.end()) return joined(value, "+");
  std::vector<std::string> words;
  for (const auto& [name, setting] : settings->second) words.push_back(name + '=' + setting);
  return value.front() + '(' + joined(words, ", ") + ')';
}

void apply(const Variation& variation, const std::vector<std::string>& value, bool is_behaviour,
           Variant& variant) {
  const std::string& path = variation.path;
  if (variation.values.size() > 1) variant.values.emplace_back(path, value_text(variation, value));
  if (!is_behaviour) {
    const std::string text = value.size() == 1 ? value[0] : '[' + joined(value, ", ") + ']';
    variant.overrides.set.push_back(path + '=' + text);
    return;
  }
  variant.overrides.with.push_back(path + '=' + joined(value, ","));
  const auto settings = variation.settings.find(value.front());
  if (settings == variation.settings.end()) return;
  // Parameters of a stage's behaviour are the stage's; those of a part's are under its name.
  const bool is_part = path.find('.') != std::string::npos;
  const std::string owner = is_part ? path + '.' + value.front() : path;
  for (const auto& [name, setting] : settings->second) {
    variant.overrides.set.push_back(owner + '.' + name + '=' + setting);
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
    const bool is_behaviour = names_a_behaviour(variation.path, stages);
    std::vector<Variant> more;
    for (const Variant& variant : variants) {
      for (const auto& value : variation.values) {
        more.push_back(variant);
        apply(variation, value, is_behaviour, more.back());
      }
    }
    variants = std::move(more);
  }
  return variants;
}

std::vector<Variation> all_variations(const Suite& suite, const BenchChanges& changes) {
  std::vector<Variation> all = suite.variations;
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
      return Error{"world '" + world.name + "' stands twice in the suite", plan.suite, 0, 0};
    }
  }
  plan.worlds.push_back(std::move(world));
  return {};
}

Result<void> add_files(const std::string& family, const std::string& pattern,
                       const runtime::ConfigPath& configs, BenchPlan& plan) {
  const auto names = configs.names("worlds");
  if (pattern.empty() || pattern.back() != '*') return add_world(plan, {family, pattern, {}});
  const std::string beginning = pattern.substr(0, pattern.size() - 1);
  bool any = false;
  for (const std::string& name : names) {
    if (name.compare(0, beginning.size(), beginning) != 0) continue;
    any = true;
    CLEW_RETURN_IF_ERROR(add_world(plan, {family, name, {}}));
  }
  if (any) return {};
  return Error{"no world's name matches '" + pattern + "'", plan.suite, 0, 0};
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
  return {};
}

/// An error in an override that a variation made is that variation's.
Error at_variation(Error error, const std::vector<Variation>& variations) {
  for (const Variation& variation : variations) {
    if (error.file != "--with " + variation.path && error.file != "--set " + variation.path) {
      continue;
    }
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
  std::string content;
  for (const auto& [name, text] : run->bundle) {
    if (name != "world.yaml") content += name + '\n' + text + '\n';
  }
  plan.configuration["graph " + variant.label()] = core::hash128(content).hex();
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
    const auto file = configs.find("worlds", world.name);
    if (!file.ok()) return file.error();
    content = core::hash128(file->text).hex();
  }
  return {};
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
    : configs_(configs), name_(world.name) {
  if (!world.order) return;
  const auto generated = trap_worlds::generate_world(*world.order);
  text_ = generated.text;
  depth_ranges_ = generated.depth_ranges;
}

Result<core::Resource> WorldSource::find(const std::string& folder, const std::string& name) const {
  if (folder == "worlds" && name == name_ && !text_.empty()) {
    return core::Resource{name + " (generated)", text_};
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
  const std::vector<Variation> variations = all_variations(suite, changes);
  plan.variants = combine(changes.graphs.empty() ? suite.graphs : changes.graphs, variations, suite,
                          changes, stages);
  CLEW_RETURN_IF_ERROR(add_worlds(suite, configs, plan));
  CLEW_RETURN_IF_ERROR(note_worlds(suite, configs, plan));
  const WorldSource source(configs, plan.worlds.front());
  for (const Variant& variant : plan.variants) {
    if (plan.configuration.count("graph " + variant.label()) > 0) {
      return Error{"'" + variant.label() + "' is asked for twice", plan.suite, 0, 0};
    }
    CLEW_RETURN_IF_ERROR(check_variant(variant, variations, source, stages, plan));
  }
  plan.configuration["max_ticks"] = std::to_string(suite.max_ticks);
  std::string& seeds = plan.configuration["seeds"];
  for (const std::uint64_t seed : suite.seeds) {
    seeds += (seeds.empty() ? "" : " ") + std::to_string(seed);
  }
  plan.configuration["suite"] = suite.name;
  return plan;
}

}  // namespace clew::bench

// SPDX-License-Identifier: Apache-2.0
#include "bench/suite.hpp"

#include <sstream>

#include "core/nearest_name.hpp"
#include "core/yaml_fields.hpp"
#include "trap_worlds/families.hpp"

namespace clew::bench {
namespace {

using core::Error;
using core::Result;
using core::YamlKind;
using core::YamlNode;

constexpr char kSuiteFormat[] = "clew-suite/1";
constexpr std::int64_t kMostWorlds = 1000;  // of a family
constexpr std::int64_t kMostSeeds = 10'000'000;
constexpr std::int64_t kMostCount = std::int64_t{1} << 53;

/// A list of texts, at least one, none twice.
Result<std::vector<std::string>> read_texts(const YamlNode& node) {
  const auto items = node.items();
  if (!items.ok()) return items.error();
  if (items->empty()) return node.error("the list is empty; expected at least one item");
  std::vector<std::string> texts;
  for (const YamlNode& item : *items) {
    const auto text = item.string();
    if (!text.ok()) return text.error();
    for (const std::string& other : texts) {
      if (other == *text) return item.error("'" + *text + "' stands twice in the list");
    }
    texts.push_back(*text);
  }
  return texts;
}

/// A behaviour with parameters that are set along with it: `{laser: {range_m: 4}}`.
Result<Variation::Value> read_behaviour(const YamlNode& node) {
  const auto behaviours = node.entries();
  if (!behaviours.ok()) return behaviours.error();
  if (behaviours->size() != 1) return node.error("expected one behaviour: {NAME: {PARAM: value}}");
  const auto& behaviour = behaviours->front();
  const auto entries = behaviour.value.entries();
  if (!entries.ok()) return entries.error();
  Variation::Value value{{behaviour.key}};
  for (const auto& entry : *entries) {
    auto text = entry.value.string();
    if (!text.ok()) return text.error();
    value.settings.emplace_back(entry.key, std::move(text).value());
  }
  return value;
}

Result<std::vector<std::string>> read_word(const YamlNode& node) {
  auto text = node.string();
  if (!text.ok()) return text.error();
  return std::vector<std::string>{std::move(text).value()};
}

/// A value of a variation: a word, a list of words, or a behaviour with parameters.
Result<Variation::Value> read_value(const YamlNode& node) {
  if (node.kind() == YamlKind::kMap) return read_behaviour(node);
  auto words = node.kind() == YamlKind::kList ? read_texts(node) : read_word(node);
  if (!words.ok()) return words.error();
  return Variation::Value{std::move(words).value()};
}

Result<void> read_variations(const YamlNode& node, const std::string& file, Suite& suite) {
  const auto entries = node.entries();
  if (!entries.ok()) return entries.error();
  for (const auto& entry : *entries) {
    Variation variation{entry.key, {}, file, entry.value.line(), entry.value.column()};
    const auto items = entry.value.items();
    if (!items.ok()) return items.error();
    if (items->empty()) return entry.value.error("the list is empty; expected at least one value");
    for (const YamlNode& item : *items) {
      auto value = read_value(item);
      if (!value.ok()) return value.error();
      variation.values.push_back(std::move(value).value());
    }
    suite.variations.push_back(std::move(variation));
  }
  return {};
}

/// `set: {PATH: value}`, of every graph.
Result<void> read_settings(const YamlNode& node, const std::string& file, Suite& suite) {
  const auto entries = node.entries();
  if (!entries.ok()) return entries.error();
  for (const auto& entry : *entries) {
    auto value = read_value(entry.value);
    if (!value.ok()) return value.error();
    suite.variations.push_back(
        {entry.key, {std::move(value).value()}, file, entry.value.line(), entry.value.column()});
  }
  return {};
}

Result<void> read_worlds(const YamlNode& node, Suite& suite) {
  const auto entries = node.entries();
  if (!entries.ok()) return entries.error();
  for (const auto& entry : *entries) {
    auto names = read_texts(entry.value);
    if (!names.ok()) return names.error();
    suite.worlds.emplace_back(entry.key, std::move(names).value());
  }
  return {};
}

Result<void> read_generated(const YamlNode& node, GeneratedWorlds& generated) {
  CLEW_RETURN_IF_ERROR(node.check_keys({"seed", "count", "families"}));
  const auto count_node = node.at("count");
  if (!count_node.ok()) return count_node.error();
  const auto count = core::count_of(*count_node, 1, kMostWorlds);
  if (!count.ok()) return count.error();
  generated.count = static_cast<int>(*count);
  if (const auto seed_node = node.find("seed")) {
    const auto seed = core::count_of(*seed_node, 0, kMostCount);
    if (!seed.ok()) return seed.error();
    generated.seed = static_cast<std::uint64_t>(*seed);
  }
  std::vector<std::string> known;
  std::vector<std::string> of_traps;
  for (const auto& family : trap_worlds::families()) {
    known.push_back(family.name);
    if (trap_worlds::is_of_traps(family)) of_traps.push_back(family.name);
  }
  const auto families_node = node.find("families");
  if (!families_node) {
    generated.families = of_traps;
    return {};
  }
  auto families = read_texts(*families_node);
  if (!families.ok()) return families.error();
  const auto items = *families_node->items();
  for (std::size_t i = 0; i < families->size(); ++i) {
    const std::string& name = (*families)[i];
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    return items[i].error(core::unknown_name("family", name, known));
  }
  generated.families = std::move(families).value();
  return {};
}

/// `seeds: {first: 1, count: 1000}`.
Result<void> read_seed_range(const YamlNode& node, Suite& suite) {
  CLEW_RETURN_IF_ERROR(node.check_keys({"first", "count"}));
  const auto count_node = node.at("count");
  if (!count_node.ok()) return count_node.error();
  const auto count = core::count_of(*count_node, 1, kMostSeeds);
  if (!count.ok()) return count.error();
  std::uint64_t seed = 1;
  if (const auto first_node = node.find("first")) {
    const auto first = core::count_of(*first_node, 0, kMostCount - kMostSeeds);
    if (!first.ok()) return first.error();
    seed = static_cast<std::uint64_t>(*first);
  }
  for (std::int64_t i = 0; i < *count; ++i) suite.seeds.push_back(seed++);
  return {};
}

/// `seeds: [1, 2, 3]`.
Result<void> read_seeds(const YamlNode& node, Suite& suite) {
  const auto items = node.items();
  if (!items.ok()) return items.error();
  if (items->empty()) return node.error("the list is empty; expected at least one seed");
  for (const YamlNode& item : *items) {
    const auto seed = core::count_of(item, 0, kMostCount);
    if (!seed.ok()) return seed.error();
    const auto value = static_cast<std::uint64_t>(*seed);
    if (std::find(suite.seeds.begin(), suite.seeds.end(), value) != suite.seeds.end()) {
      return item.error("seed " + std::to_string(value) + " stands twice in the list");
    }
    suite.seeds.push_back(value);
  }
  return {};
}

Result<void> read_numbers(const YamlNode& root, Suite& suite) {
  if (const auto node = root.find("max_ticks")) {
    const auto value = core::count_of(*node, 1, kMostCount);
    if (!value.ok()) return value.error();
    suite.max_ticks = static_cast<std::uint64_t>(*value);
  }
  const auto node = root.find("seeds");
  if (!node) return {};
  suite.seeds.clear();
  return node->kind() == YamlKind::kMap ? read_seed_range(*node, suite) : read_seeds(*node, suite);
}

/// `data: barn`: worlds that the user has.
Result<void> read_data(const YamlNode& root, Suite& suite) {
  const auto node = root.find("data");
  if (!node) return {};
  const auto word = node->string();
  if (!word.ok()) return word.error();
  if (*word != "barn") return node->error("found " + node->found() + "; allowed: barn");
  suite.needs_barn = true;
  return {};
}

Result<void> read_about(const YamlNode& root, Suite& suite) {
  const auto node = root.find("about");
  if (!node) return {};
  auto text = node->string();
  if (!text.ok()) return text.error();
  suite.about = std::move(text).value();
  return {};
}

/// `by: [severity, nesting]`.
Result<void> read_groupings(const YamlNode& node, Suite& suite) {
  const auto names = read_texts(node);
  if (!names.ok()) return names.error();
  const auto items = *node.items();
  for (std::size_t i = 0; i < names->size(); ++i) {
    const auto grouping = read_grouping((*names)[i]);
    if (!grouping.ok()) return items[i].error(grouping.error().message);
    suite.by.push_back(*grouping);
  }
  return {};
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> words;
  std::istringstream stream(text);
  for (std::string word; std::getline(stream, word, separator);) words.push_back(word);
  return words;
}

}  // namespace

Result<Suite> read_suite(const core::Resource& file, const std::string& name) {
  const auto root = YamlNode::parse(file.text, file.file);
  if (!root.ok()) return root.error();
  CLEW_RETURN_IF_ERROR(core::check_format(*root, kSuiteFormat));
  CLEW_RETURN_IF_ERROR(root->check_keys({"format", "about", "graphs", "set", "vary", "worlds",
                                         "generated", "data", "seeds", "max_ticks", "by"}));
  Suite suite;
  suite.name = name;
  CLEW_RETURN_IF_ERROR(read_about(*root, suite));
  const auto graphs_node = root->at("graphs");
  if (!graphs_node.ok()) return graphs_node.error();
  auto graphs = read_texts(*graphs_node);
  if (!graphs.ok()) return graphs.error();
  suite.graphs = std::move(graphs).value();
  if (const auto node = root->find("set")) {
    CLEW_RETURN_IF_ERROR(read_settings(*node, file.file, suite));
  }
  if (const auto node = root->find("vary")) {
    CLEW_RETURN_IF_ERROR(read_variations(*node, file.file, suite));
  }
  if (const auto node = root->find("worlds")) CLEW_RETURN_IF_ERROR(read_worlds(*node, suite));
  if (const auto node = root->find("generated")) {
    CLEW_RETURN_IF_ERROR(read_generated(*node, suite.generated));
  }
  CLEW_RETURN_IF_ERROR(read_data(*root, suite));
  CLEW_RETURN_IF_ERROR(read_numbers(*root, suite));
  if (const auto node = root->find("by")) CLEW_RETURN_IF_ERROR(read_groupings(*node, suite));
  if (suite.worlds.empty() && suite.generated.count == 0 && !suite.needs_barn) {
    return root->error("no worlds; expected 'worlds', 'generated' or both");
  }
  return suite;
}

Result<Grouping> read_grouping(const std::string& name) {
  if (const auto grouping = grouping_of(name)) return *grouping;
  return Error{core::unknown_name("grouping", name, grouping_names())};
}

Result<Variation> read_variation(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
    return Error{"expected PATH=VALUE,VALUE,..., found '" + text + "'", "--vary"};
  }
  Variation variation{text.substr(0, equals), {}};
  variation.file = "--vary " + variation.path;
  for (const std::string& value : split(text.substr(equals + 1), ',')) {
    variation.values.push_back({split(value, '+')});
    if (value.empty()) return Error{"an empty value in '" + text + "'", "--vary"};
  }
  return variation;
}

}  // namespace clew::bench

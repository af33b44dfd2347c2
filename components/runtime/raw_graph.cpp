// SPDX-License-Identifier: Apache-2.0
#include "runtime/raw_graph.hpp"

#include <algorithm>
#include <limits>

#include "core/nearest_name.hpp"
#include "core/yaml_fields.hpp"
#include "runtime/goals.hpp"
#include "runtime/plugin_list.hpp"

namespace clew::runtime {
namespace {

const std::vector<std::string> kLayouts = {"processes", "composed"};

using core::Error;
using core::Result;
using core::YamlKind;
using core::YamlNode;

// What a graph without a mission means: the robot goes straight for the world's target.
constexpr char kPlainMission[] = "target";

// A choice is `name`, or `{name: {parameter: value, ...}}`.
Result<RawChoice> read_choice(const YamlNode& node) {
  if (node.kind() != YamlKind::kMap) {
    auto name = node.string();
    if (!name.ok()) {
      return node.error("expected a behaviour's name, or {name: {parameter: value}}; found " +
                        node.found());
    }
    return RawChoice{*name, node, {}};
  }
  const auto entries = node.entries();
  if (!entries.ok()) return entries.error();
  if (entries->size() != 1) {
    return node.error("expected one behaviour as {name: {parameter: value}}; found " +
                      node.found() + " with " + std::to_string(entries->size()) + " keys");
  }
  const auto& entry = entries->front();
  RawChoice choice{entry.key, entry.key_node, {}};
  if (entry.value.kind() == YamlKind::kNull) return choice;
  const auto parameters = entry.value.entries();
  if (!parameters.ok()) return parameters.error();
  for (const auto& parameter : *parameters) {
    choice.parameters.push_back({parameter.key, parameter.key_node, parameter.value});
  }
  return choice;
}

Result<std::vector<RawChoice>> read_choices(const PartInfo& part, const YamlNode& node) {
  if (part.name == kBehaviourPart && node.kind() != YamlKind::kScalar) {
    return node.error("expected a behaviour's name, with its parameters beside it; found " +
                      node.found());
  }
  if (!part.is_list) {
    auto choice = read_choice(node);
    if (!choice.ok()) return choice.error();
    return std::vector<RawChoice>{std::move(choice).value()};
  }
  const auto items = node.items();
  if (!items.ok()) return items.error();
  std::vector<RawChoice> choices;
  for (const YamlNode& item : *items) {
    auto choice = read_choice(item);
    if (!choice.ok()) return choice.error();
    for (const RawChoice& other : choices) {
      if (other.name == choice->name) {
        return item.error("'" + choice->name + "' stands twice in the list of " + part.name);
      }
    }
    choices.push_back(std::move(choice).value());
  }
  return choices;
}

const std::vector<std::string> kDeploymentKeys = {"process", "exec", "ros2", "via", "restart"};

/// Whether the word is `yes`, of the two that are allowed.
Result<bool> read_either(const YamlNode& node, const std::string& key, const char* no,
                         const char* yes) {
  const auto word = node.string();
  if (!word.ok()) return word.error();
  if (*word == yes || *word == no) return *word == yes;
  return node.error(core::unknown_name("value of " + key, *word, {no, yes}));
}

/// Words and numbers; which there are is not known here.
Result<void> read_robot_setting(const std::string& key, const YamlNode& node,
                                std::map<std::string, std::string>& settings) {
  auto word = node.string();
  if (word.ok()) settings[key] = std::move(word).value();
  return word.ok() ? Result<void>() : word.error();
}

Result<void> read_deployment(const YamlNode& node, const std::string& key, Deployment& deployment) {
  if (key == "via" || key == "restart") {
    const bool via = key == "via";
    const auto yes =
        read_either(node, key, via ? "dds" : "never", via ? "json_lines" : "stateless");
    if (!yes.ok()) return yes.error();
    (via ? deployment.json_lines : deployment.stateless) = *yes;
    return {};
  }
  if (key == "exec") {
    const auto items = node.items();
    if (!items.ok()) return items.error();
    if (items->empty()) return node.error("exec is empty; expected [program, argument, ...]");
    for (const YamlNode& item : *items) {
      auto word = item.string();
      if (!word.ok()) return word.error();
      deployment.exec.push_back(*word);
    }
    return {};
  }
  if (key == "process") CLEW_RETURN_IF_ERROR(node.check_keys(process_settings()));
  if (key == "ros2") deployment.ros2.emplace();
  const auto entries = node.entries();
  if (!entries.ok()) return entries.error();
  for (const auto& entry : *entries) {
    CLEW_RETURN_IF_ERROR(key == "ros2"
                             ? read_robot_setting(entry.key, entry.value, *deployment.ros2)
                             : read_process_setting(entry.key, entry.value, deployment));
  }
  return {};
}

Result<RawStage> read_stage(const StageInfo& info, const YamlNode& node) {
  RawStage stage{&info, node, {}, {}, {}};
  const auto entries = node.entries();
  if (!entries.ok()) return entries.error();
  for (const auto& entry : *entries) {
    const bool is_deployment = std::find(kDeploymentKeys.begin(), kDeploymentKeys.end(),
                                         entry.key) != kDeploymentKeys.end();
    if (is_deployment) {
      CLEW_RETURN_IF_ERROR(read_deployment(entry.value, entry.key, stage.deployment));
    } else if (const PartInfo* part = find_part(info, entry.key)) {
      auto choices = read_choices(*part, entry.value);
      if (!choices.ok()) return choices.error();
      stage.parts[entry.key] = std::move(choices).value();
    } else {
      stage.parameters.push_back({entry.key, entry.key_node, entry.value});
    }
  }
  for (const char* key : {"via", "restart"}) {
    const auto found = node.find(key);
    if (!found || !stage.deployment.exec.empty()) continue;
    return found->error(std::string(key) + " stands beside exec, and " + info.name + " has none");
  }
  return stage;
}

/// `security: minted`, or `security: {directory: DIR}`.
Result<void> read_security(const YamlNode& root, Graph& head) {
  const auto node = root.find("security");
  if (!node) return {};
  if (node->kind() == YamlKind::kMap) {
    CLEW_RETURN_IF_ERROR(node->check_keys({"directory"}));
    const auto directory = node->at("directory");
    if (!directory.ok()) return directory.error();
    auto path = directory->string();
    if (!path.ok()) return path.error();
    if (path->empty()) return directory->error("found no path of a directory of keys");
    head.security = std::move(path).value();
    return {};
  }
  const auto word = node->string();
  if (!word.ok() || *word != kMintedKeys) {
    return node->error("security is " + node->found() + "; allowed: " + kMintedKeys +
                       ", {directory: DIR}");
  }
  head.security.emplace();
  return {};
}

Result<void> read_robot_index(const YamlNode& root, std::uint64_t& index) {
  if (!root.find("robot_index")) return {};
  return core::read_count(root, "robot_index", 0, domain::kMostRobots - 1, index);
}

Result<void> read_head(const YamlNode& root, Graph& head) {
  const auto text = [&](const char* key, std::string& field, bool required) -> Result<void> {
    if (!required && !root.find(key)) return {};
    const auto node = root.at(key);
    if (!node.ok()) return node.error();
    auto value = node->string();
    if (!value.ok()) return value.error();
    field = *value;
    return {};
  };
  std::string about;
  CLEW_RETURN_IF_ERROR(text("about", about, false));
  CLEW_RETURN_IF_ERROR(text("world", head.world, true));
  CLEW_RETURN_IF_ERROR(text("robot", head.robot, true));
  head.place = place_of(root);
  head.world_place = place_of(*root.find("world"));
  head.robot_place = place_of(*root.find("robot"));
  const auto count = [&](const char* key, std::uint64_t& field) -> Result<void> {
    constexpr auto kMost = std::numeric_limits<std::int64_t>::max();
    return root.find(key) ? core::read_count(root, key, 0, kMost, field) : Result<void>();
  };
  CLEW_RETURN_IF_ERROR(count("seed", head.seed));
  CLEW_RETURN_IF_ERROR(count("max_ticks", head.max_ticks));
  CLEW_RETURN_IF_ERROR(read_robot_index(root, head.robot_index));
  if (const auto node = root.find("start_timeout_s")) {
    const auto value = node->number();
    if (!value.ok()) return value.error();
    if (*value < 0.1 || *value > 3600.0) {
      return node->error("start_timeout_s is " + node->found() + "; allowed: 0.1 to 3600 s");
    }
    head.start_timeout_s = *value;
  }
  auto goals = read_goals(root);
  if (!goals.ok()) return goals.error();
  if (*goals) {
    head.goals_place = place_of((*goals)->where);
    head.goals = std::move((*goals)->goals);
  }
  if (const auto node = root.find("layout")) {
    CLEW_RETURN_IF_ERROR(text("layout", head.layout, true));
    if (std::find(kLayouts.begin(), kLayouts.end(), head.layout) == kLayouts.end()) {
      return node->error(core::unknown_name("layout", head.layout, kLayouts));
    }
  }
  return read_security(root, head);
}

/// A mission's word, and the stage that it is short for.
struct ShortForm {
  const StageInfo* stage;
  const MissionInfo* mission;
};

Result<ShortForm> find_mission(const YamlNode& node, const std::string& word,
                               const std::vector<StageInfo>& stages) {
  std::vector<std::string> known = {kPlainMission};
  for (const StageInfo& stage : stages) {
    for (const MissionInfo& mission : stage.missions) {
      if (mission.word == word) return ShortForm{&stage, &mission};
      known.push_back(mission.word);
    }
  }
  return node.error(core::unknown_name("mission", word, known));
}

/// The stage that the graph's mission is short for; none if it says no mission, or the plain one.
Result<std::optional<RawStage>> read_mission(const YamlNode& root,
                                             const std::vector<StageInfo>& stages) {
  const auto node = root.find("mission");
  if (!node || node->kind() == YamlKind::kList) return std::optional<RawStage>();
  const auto word = node->string();
  if (!word.ok()) return word.error();
  if (*word == kPlainMission) return std::optional<RawStage>();
  const auto found = find_mission(*node, *word, stages);
  if (!found.ok()) return found.error();
  const std::string& name = found->stage->name;
  const std::string& behaviour = found->mission->behaviour;
  if (root.find(name)) {
    return node->error("mission: " + *word + " is short for " + name +
                       ": {behaviour: " + behaviour + "}; found it beside a " + name);
  }
  RawStage stage{found->stage, *node, {}, {}, {}};
  stage.parts[kBehaviourPart] = {RawChoice{behaviour, *node, {}}};
  return std::optional<RawStage>(std::move(stage));
}

}  // namespace

Place place_of(const YamlNode& node) { return {node.file(), node.line(), node.column()}; }

const PartInfo* find_part(const StageInfo& stage, const std::string& name) {
  for (const PartInfo& part : stage.parts) {
    if (part.name == name) return &part;
  }
  return nullptr;
}

bool declares(const std::vector<core::ParameterInfo>& infos, const std::string& name) {
  return std::any_of(infos.begin(), infos.end(),
                     [&](const core::ParameterInfo& info) { return info.name == name; });
}

Result<const VariantInfo*> find_variant(const StageInfo& stage, const PartInfo& part,
                                        const RawChoice& choice) {
  if (const VariantInfo* found = part.find(choice.name)) return found;
  std::vector<std::string> known;
  for (const VariantInfo& variant : part.variants) known.push_back(variant.name);
  return choice.where.error(core::unknown_name(stage.name + ' ' + part.name, choice.name, known));
}

Result<RawGraph> read_raw_graph(const core::Resource& file, const std::string& name,
                                const std::vector<StageInfo>& stages) {
  const auto root = YamlNode::parse(file.text, file.file);
  if (!root.ok()) return root.error();
  std::vector<std::string> keys = {"name",      "about",           "world",      "robot", "seed",
                                   "max_ticks", "start_timeout_s", "mission",    "goal",  "layout",
                                   "security",  "plugins",         "robot_index"};
  for (const StageInfo& stage : stages) keys.push_back(stage.name);
  if (const auto format = root->find("format")) {
    return format->error("found a file of the format " + format->found() +
                         ", expected a graph, which has none");
  }
  if (const auto robots = root->find("robots")) {
    return robots->error("found a fleet, which `clew run` takes; expected a graph of one robot");
  }
  CLEW_RETURN_IF_ERROR(root->check_keys(keys));
  // Before the behaviours: an unknown one is explained by a plug-in that is missing.
  CLEW_RETURN_IF_ERROR(check_plugins(*root));

  RawGraph graph{{}, *root, {}};
  graph.head.name = name;
  if (const auto own_name = root->find("name")) {
    auto text = own_name->string();
    if (!text.ok()) return text.error();
    graph.head.name = std::move(text).value();
  }
  CLEW_RETURN_IF_ERROR(read_head(*root, graph.head));
  auto short_form = read_mission(*root, stages);
  if (!short_form.ok()) return short_form.error();
  for (const StageInfo& info : stages) {
    if (*short_form && (*short_form)->info == &info) {
      graph.stages.push_back(std::move(**short_form));
    }
    const auto node = root->find(info.name);
    if (!node) continue;
    auto stage = read_stage(info, *node);
    if (!stage.ok()) return stage.error();
    graph.stages.push_back(std::move(stage).value());
  }
  return graph;
}

}  // namespace clew::runtime

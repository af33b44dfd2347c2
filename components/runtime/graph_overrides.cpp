// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>
#include <sstream>

#include "core/nearest_name.hpp"
#include "runtime/raw_graph.hpp"

namespace clew::runtime {
namespace {

using core::Error;
using core::Result;
using core::YamlNode;

struct Assignment {
  std::string option;             ///< `--set control.turn_deg`
  std::vector<std::string> path;  ///< what stands before `=`, split at the dots
  YamlNode value;
};

Result<Assignment> split(const std::string& option, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    return Error{"expected a name, '=' and a value; found '" + text + "'", option};
  }
  const std::string left = text.substr(0, equals);
  const std::string label = option + ' ' + left;
  std::vector<std::string> path;
  std::istringstream stream(left);
  for (std::string word; std::getline(stream, word, '.');) path.push_back(word);
  const std::string right = text.substr(equals + 1);
  if (right.empty()) return Error{"no value after '='", label};
  auto value = YamlNode::parse(right, label);
  if (!value.ok()) return value.error();
  return Assignment{label, std::move(path), *value};
}

Error given_twice(const Assignment& assignment) {
  return Error{"is given twice; once is allowed", assignment.option};
}

Result<RawStage*> find_stage(RawGraph& graph, const Assignment& assignment) {
  std::vector<std::string> known;
  for (RawStage& stage : graph.stages) {
    if (stage.info->name == assignment.path.front()) return &stage;
    known.push_back(stage.info->name);
  }
  return Error{core::unknown_name("stage of this graph", assignment.path.front(), known),
               assignment.option};
}

const VariantInfo* variant_of(const StageInfo& stage, const std::string& part_name,
                              const std::string& name) {
  const PartInfo* part = find_part(stage, part_name);
  return part == nullptr ? nullptr : part->find(name);
}

// The parameters that a swapped-out behaviour leaves behind mean nothing to the new one.
void drop_parameters_of(RawStage& stage, const std::string& old_name) {
  const VariantInfo* old_variant = variant_of(*stage.info, kBehaviourPart, old_name);
  if (old_variant == nullptr) return;
  auto& given = stage.parameters;
  given.erase(std::remove_if(given.begin(), given.end(),
                             [&](const RawParameter& parameter) {
                               return declares(old_variant->parameters, parameter.name) &&
                                      !declares(stage.info->parameters, parameter.name);
                             }),
              given.end());
}

Error unknown_part(const StageInfo& stage, const std::string& name, const Assignment& assignment) {
  std::vector<std::string> known;
  for (const PartInfo& part : stage.parts) known.push_back(part.name);
  return Error{core::unknown_name("part of " + stage.name, name, known), assignment.option};
}

// The names of `--with STAGE.PART=NAME[,NAME...]`.
Result<std::vector<RawChoice>> read_names(const StageInfo& stage, const PartInfo& part,
                                          const std::string& text, const Assignment& assignment) {
  std::vector<RawChoice> choices;
  std::istringstream stream(text);
  for (std::string name; std::getline(stream, name, ',');) {
    for (const RawChoice& other : choices) {
      if (other.name == name) {
        return Error{"'" + name + "' stands twice in the list of " + part.name, assignment.option};
      }
    }
    choices.push_back({name, assignment.value, {}});
  }
  if (part.is_list || choices.size() == 1) return choices;
  return Error{
      stage.name + '.' + part.name + " takes one name, found " + std::to_string(choices.size()),
      assignment.option};
}

Result<void> apply_with(const std::string& text, RawGraph& graph) {
  const auto assignment = split("--with", text);
  if (!assignment.ok()) return assignment.error();
  const auto stage = find_stage(graph, *assignment);
  if (!stage.ok()) return stage.error();
  const StageInfo& info = *(*stage)->info;
  const std::vector<std::string>& path = assignment->path;
  if (path.size() > 2) {
    return Error{"expected STAGE[.PART]=NAME[,NAME...], found '" + text + "'", assignment->option};
  }
  const std::string part_name = path.size() > 1 ? path[1] : std::string(kBehaviourPart);
  const PartInfo* part = find_part(info, part_name);
  if (part == nullptr) return unknown_part(info, part_name, *assignment);
  auto choices = read_names(info, *part, text.substr(text.find('=') + 1), *assignment);
  if (!choices.ok()) return choices.error();
  if (!(*stage)->parts_by_option.insert(part_name).second) return given_twice(*assignment);
  auto& current = (*stage)->parts[part_name];
  if (part_name == kBehaviourPart && !current.empty() &&
      current.front().name != choices->front().name) {
    drop_parameters_of(**stage, current.front().name);
  }
  // A behaviour that stays keeps its parameters.
  for (RawChoice& choice : *choices) {
    for (RawChoice& old : current) {
      if (old.name == choice.name) choice.parameters = old.parameters;
    }
  }
  current = std::move(choices).value();
  return {};
}

Result<void> assign(const Assignment& assignment, std::vector<RawParameter>& parameters) {
  const RawParameter given{assignment.path.back(), assignment.value, assignment.value, true};
  for (RawParameter& parameter : parameters) {
    if (parameter.name != given.name) continue;
    if (parameter.by_option) return given_twice(assignment);
    parameter = given;
    return {};
  }
  parameters.push_back(given);
  return {};
}

// STAGE.PART.PARAM means the one chosen behaviour that has PARAM.
Result<RawChoice*> find_choice(RawStage& stage, const Assignment& assignment) {
  const std::string& part = assignment.path[1];
  auto& choices = stage.parts[part];
  const bool named = assignment.path.size() == 4;
  const std::string& parameter = assignment.path.back();
  std::vector<std::string> known;
  std::vector<RawChoice*> fitting;
  for (RawChoice& choice : choices) {
    known.push_back(choice.name);
    const VariantInfo* variant = variant_of(*stage.info, part, choice.name);
    const bool has = variant != nullptr && declares(variant->parameters, parameter);
    if (named ? choice.name == assignment.path[2] : has) fitting.push_back(&choice);
  }
  if (fitting.size() == 1) return fitting.front();
  if (named) {
    return Error{core::unknown_name("chosen " + part, assignment.path[2], known),
                 assignment.option};
  }
  if (fitting.empty() && choices.size() == 1) return &choices.front();
  return Error{std::to_string(fitting.size()) + " of the chosen " + part + " have a parameter '" +
                   parameter + "'; name one as " + stage.info->name + '.' + part + ".NAME." +
                   parameter,
               assignment.option};
}

/// The chosen behaviours' parameters of a stage's parts, as --set names them:
/// `recover.detector.rise_m`.
std::vector<std::string> parameters_of_parts(const RawStage& stage) {
  std::vector<std::string> paths;
  for (const auto& [part, choices] : stage.parts) {
    if (part == kBehaviourPart) continue;
    for (const RawChoice& choice : choices) {
      const VariantInfo* variant = variant_of(*stage.info, part, choice.name);
      if (variant == nullptr) continue;
      for (const core::ParameterInfo& info : variant->parameters) {
        paths.push_back(stage.info->name + '.' + part + '.' + info.name);
      }
    }
  }
  return paths;
}

std::string last_word(const std::string& path) { return path.substr(path.rfind('.') + 1); }

/// `--set recover.rise=1` may mean a parameter of one of the stage's parts: the nearest is named,
/// one that only lacks its unit before all.
Result<void> check_known(const RawStage& stage, const Assignment& assignment) {
  const std::string& name = assignment.path.back();
  const auto behaviour = stage.parts.find(kBehaviourPart);
  const VariantInfo* variant =
      behaviour == stage.parts.end() || behaviour->second.empty()
          ? nullptr
          : variant_of(*stage.info, kBehaviourPart, behaviour->second.front().name);
  const bool is_known = declares(stage.info->parameters, name) ||
                        (variant != nullptr && declares(variant->parameters, name));
  const std::vector<std::string> paths = parameters_of_parts(stage);
  if (is_known || paths.empty()) return {};
  std::vector<std::string> names;
  for (const std::string& path : paths) names.push_back(last_word(path));
  const std::string nearest = core::nearest_name(name, names);
  for (const std::string& path : paths) {
    const std::string word = last_word(path);
    if (word.compare(0, name.size() + 1, name + '_') != 0 && word != nearest) continue;
    return Error{"unknown parameter of " + stage.info->name + " '" + name + "' (did you mean '" +
                     path + "'?); 'clew list " + stage.info->name + "' tells all",
                 assignment.option};
  }
  return {};
}

Result<void> apply_set(const std::string& text, RawGraph& graph) {
  const auto assignment = split("--set", text);
  if (!assignment.ok()) return assignment.error();
  const auto stage = find_stage(graph, *assignment);
  if (!stage.ok()) return stage.error();
  const std::vector<std::string>& path = assignment->path;
  if (path.size() < 2 || path.size() > 4) {
    return Error{"expected STAGE[.PART][.NAME].PARAM=VALUE, found '" + text + "'",
                 assignment->option};
  }
  const StageInfo& info = *(*stage)->info;
  if (path.size() == 3 && path[1] == "process") {
    return read_process_setting(path[2], assignment->value, (*stage)->deployment);
  }
  const bool is_part = find_part(info, path[1]) != nullptr;
  if (path.size() == 2) {
    if (is_part || path[1] == "process" || path[1] == "exec") {
      return Error{
          "'" + path[1] + "' is no parameter" +
              (is_part ? "; choose it by --with " + path[0] + '.' + path[1] + "=NAME" : ""),
          assignment->option};
    }
    CLEW_RETURN_IF_ERROR(check_known(**stage, *assignment));
    return assign(*assignment, (*stage)->parameters);
  }
  if (!is_part) return unknown_part(info, path[1], *assignment);
  const auto choice = find_choice(**stage, *assignment);
  if (!choice.ok()) return choice.error();
  return assign(*assignment,
                path[1] == kBehaviourPart ? (*stage)->parameters : (*choice)->parameters);
}

// A graph file holds signed numbers, and the expanded graph is one.
Result<void> check_count(const char* option, const std::optional<std::uint64_t>& count) {
  constexpr auto kMost = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  if (!count || *count <= kMost) return {};
  return Error{"found " + std::to_string(*count) + "; allowed: 0 to " + std::to_string(kMost),
               option};
}

}  // namespace

Result<void> apply_overrides(const GraphOverrides& overrides, RawGraph& graph) {
  CLEW_RETURN_IF_ERROR(check_count("--seed", overrides.seed));
  CLEW_RETURN_IF_ERROR(check_count("--max-ticks", overrides.max_ticks));
  if (overrides.world) {
    graph.head.world = *overrides.world;
    graph.head.world_place = {"--world", 0, 0};
  }
  if (overrides.robot) {
    graph.head.robot = *overrides.robot;
    graph.head.robot_place = {"--robot", 0, 0};
  }
  if (overrides.goals) {
    graph.head.goals = overrides.goals;
    graph.head.goals_place = {"goal", 0, 0};
  }
  if (overrides.seed) graph.head.seed = *overrides.seed;
  if (overrides.max_ticks) graph.head.max_ticks = *overrides.max_ticks;
  if (overrides.robot_index) graph.head.robot_index = *overrides.robot_index;
  for (const std::string& text : overrides.with) CLEW_RETURN_IF_ERROR(apply_with(text, graph));
  for (const std::string& text : overrides.set) CLEW_RETURN_IF_ERROR(apply_set(text, graph));
  return {};
}

}  // namespace clew::runtime

// SPDX-License-Identifier: Apache-2.0
#include "runtime/graph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>

#include "core/nearest_name.hpp"
#include "runtime/raw_graph.hpp"
#include "runtime/wiring.hpp"

namespace clew::runtime {
namespace {

using core::Error;
using core::Result;

// The data files that parameters name, each with the place that names it: that of `owner` for a
// default.
void note_files(const std::vector<core::ParameterInfo>& infos, const core::ParameterValues& values,
                const std::vector<RawParameter>& given, const core::YamlNode& owner,
                std::vector<NamedFile>& files) {
  for (const core::ParameterInfo& info : infos) {
    if (info.folder.empty()) continue;
    const auto& name = std::get<std::string>(values.at(info.name));
    if (name.empty()) continue;
    Place place = place_of(owner);
    for (const RawParameter& parameter : given) {
      if (parameter.name == info.name) place = place_of(parameter.value);
    }
    files.push_back({info.name, info.folder, name, std::move(place)});
  }
}

Result<PartChoice> resolve_choice(const StageInfo& stage, const PartInfo& part,
                                  const RawChoice& choice, std::vector<NamedFile>& files) {
  const auto variant = find_variant(stage, part, choice);
  if (!variant.ok()) return variant.error();
  auto values = resolve_parameters((*variant)->parameters, choice.parameters,
                                   stage.name + '.' + part.name + '.' + choice.name);
  if (!values.ok()) return values.error();
  note_files((*variant)->parameters, *values, choice.parameters, choice.where, files);
  return PartChoice{choice.name, std::move(values).value()};
}

// The keys of a stage's map belong to the stage or to its behaviour; a key of neither is answered
// with the names of both.
Result<void> distribute_parameters(const RawStage& raw, std::vector<RawParameter>& of_stage,
                                   RawChoice* behaviour) {
  const StageInfo& info = *raw.info;
  const VariantInfo* variant = nullptr;
  if (behaviour != nullptr) {
    const auto found = find_variant(info, *find_part(info, kBehaviourPart), *behaviour);
    if (!found.ok()) return found.error();
    variant = *found;
  }
  for (const RawParameter& parameter : raw.parameters) {
    if (declares(info.parameters, parameter.name)) {
      of_stage.push_back(parameter);
    } else if (variant != nullptr && declares(variant->parameters, parameter.name)) {
      behaviour->parameters.push_back(parameter);
    } else {
      // --set gives parameters, a file all that a stage's map may hold.
      std::vector<std::string> known;
      if (!parameter.by_option) {
        known = {"process", "exec", "ros2", "via", "restart"};
        for (const PartInfo& part : info.parts) known.push_back(part.name);
      }
      for (const auto& own : info.parameters) known.push_back(own.name);
      if (variant != nullptr) {
        for (const auto& own : variant->parameters) known.push_back(own.name);
      }
      return parameter.where.error(core::unknown_name(
          (parameter.by_option ? "parameter of " : "key of ") + info.name, parameter.name, known));
    }
  }
  return {};
}

bool starts_ticks(const StageInfo& info) {
  return std::any_of(info.ports.begin(), info.ports.end(),
                     [](const PortInfo& port) { return port.delayed; });
}

/// Whether others must know of the stage before the run what a third-party component cannot
/// tell them: the arrangement of its scans, or the tick and limits that it has.
bool declares_itself(const StageInfo& info) {
  return info.scan_layout != nullptr || starts_ticks(info);
}

// The behaviour that stands beside exec or ros2 says so. Whatever else stood there would be unused.
Result<void> check_beside_exec(const RawStage& raw) {
  const bool is_robot = raw.deployment.ros2.has_value();
  const std::string has = raw.info->name + (is_robot ? " has ros2" : " has exec");
  if (is_robot && !raw.deployment.exec.empty()) {
    return raw.where.error(has + " and exec; one is allowed");
  }
  if (!declares_itself(*raw.info) && is_robot) {
    return raw.where.error(has + ": a robot takes the place of stages that have a body only");
  }
  if (!declares_itself(*raw.info) && !(raw.parts.empty() && raw.parameters.empty())) {
    return raw.where.error(has +
                           ": a third-party component takes no behaviour and no "
                           "parameters here");
  }
  if (declares_itself(*raw.info) && raw.parts.count(kBehaviourPart) == 0) {
    return raw.where.error(has + ", and needs beside it the behaviour, with its parameters, " +
                           (raw.info->scan_layout != nullptr
                                ? "whose arrangement of beams its scans have"
                                : "whose tick and limits it has"));
  }
  for (const RawParameter& parameter : raw.parameters) {
    if (!declares(raw.info->parameters, parameter.name)) continue;
    return parameter.where.error(has + ": " + parameter.name +
                                 " would be a parameter of ours, and nobody would use it");
  }
  return {};
}

Result<GraphStage> resolve_stage(RawStage raw) {
  const StageInfo& info = *raw.info;
  GraphStage stage{&info, {info.name, {}, {}}, raw.deployment, {}, place_of(raw.where), {}};
  if (!raw.deployment.is_ours()) {
    CLEW_RETURN_IF_ERROR(check_beside_exec(raw));
    if (!declares_itself(info)) return stage;
  }
  for (const PartInfo& part : info.parts) {
    auto& choices = raw.parts[part.name];
    if (!part.is_list && choices.empty()) {
      return raw.where.error("key '" + part.name + "' is missing in " + info.name);
    }
  }
  std::vector<RawParameter> of_stage;
  const auto behaviour = raw.parts.find(kBehaviourPart);
  CLEW_RETURN_IF_ERROR(distribute_parameters(
      raw, of_stage, behaviour == raw.parts.end() ? nullptr : &behaviour->second.front()));
  auto values = resolve_parameters(info.parameters, of_stage, info.name);
  if (!values.ok()) return values.error();
  note_files(info.parameters, *values, of_stage, raw.where, stage.files);
  stage.config.parameters = std::move(values).value();
  for (const PartInfo& part : info.parts) {
    auto& resolved = stage.config.parts[part.name];
    for (const RawChoice& choice : raw.parts[part.name]) {
      auto one = resolve_choice(info, part, choice, stage.files);
      if (!one.ok()) return one.error();
      resolved.push_back(std::move(one).value());
    }
  }
  return stage;
}

Result<void> settle_tick(const std::vector<StageInfo>& stages, Graph& graph) {
  std::string who;
  for (const GraphStage& stage : graph.stages) {
    if (!stage.info->tick_s || stage.config.parts.empty()) continue;
    const double tick_s = stage.info->tick_s(stage.config);
    if (tick_s <= 0.0) continue;
    if (graph.tick_s > 0.0 && graph.tick_s != tick_s) {
      return stage.place.error(fmt::format("{} needs a tick of {} s, {} one of {} s",
                                           stage.info->name, tick_s, who, graph.tick_s));
    }
    graph.tick_s = tick_s;
    who = stage.info->name;
  }
  if (graph.tick_s <= 0.0) {
    return graph.place.error("no stage says how long a tick lasts; a graph needs " +
                             writer_of(Topic::kState, stages));
  }
  return {};
}

/// With its role before it, the common name of a certificate, which has 64 letters.
constexpr std::size_t kLongestHostName = 48;

/// What the stages of a group do not agree about, although their process can have it but once.
std::string disagreement(const GraphStage& a, const GraphStage& b) {
  const auto said = [](const std::string& word) {
    return word.empty() ? std::string("none") : word;
  };
  const Deployment& one = a.deployment;
  const Deployment& other = b.deployment;
  const auto text = [&](const char* what, const auto& of_a, const auto& of_b) {
    return fmt::format("one {}; found {} in {} and {} in {}", what, of_a, a.info->name, of_b,
                       b.info->name);
  };
  if (one.middleware != other.middleware) {
    return text("middleware", said(one.middleware), said(other.middleware));
  }
  if (one.restart_limit != other.restart_limit) {
    return text("restart_limit", one.restart_limit, other.restart_limit);
  }
  if (one.restart_backoff_s != other.restart_backoff_s) {
    return text("restart_backoff_s", one.restart_backoff_s, other.restart_backoff_s);
  }
  if (one.host != other.host) return text("host", said(one.host), said(other.host));
  return {};
}

Result<void> check_groups(const std::vector<StageInfo>& stages, const Graph& graph) {
  // A run may have a process of each of these names.
  std::vector<std::string> taken = {"recorder",  "observer", "replay",
                                    "commander", "watcher",  "run"};
  for (const StageInfo& info : stages) taken.push_back(info.name);
  std::map<std::string, const GraphStage*> first_of;
  for (const GraphStage& stage : graph.stages) {
    const Deployment& deployment = stage.deployment;
    if (deployment.group.empty()) continue;
    if (!deployment.exec.empty()) {
      return deployment.group_place.error(
          stage.info->name +
          " has exec: a third-party component is a process of its own, and in no group");
    }
    if (std::count(taken.begin(), taken.end(), deployment.group) > 0) {
      return deployment.group_place.error("group '" + deployment.group +
                                          "' has the name of another process; allowed: any but " +
                                          fmt::format("{}", fmt::join(taken, ", ")));
    }
    const GraphStage& first = *first_of.emplace(deployment.group, &stage).first->second;
    const std::string differs = disagreement(first, stage);
    if (differs.empty()) continue;
    return deployment.group_place.error("the stages of group '" + deployment.group +
                                        "' share a process, and so " + differs);
  }
  return {};
}

}  // namespace

bool is_host_name(const std::string& name) {
  const bool plain = std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '.' || c == '_';
  });
  return plain && !name.empty() && name.size() <= kLongestHostName && name.front() != '-';
}

const GraphStage* Graph::find(const std::string& stage) const {
  for (const GraphStage& candidate : stages) {
    if (candidate.info->name == stage) return &candidate;
  }
  return nullptr;
}

const GraphStage* Graph::writer_of(Topic topic) const {
  for (const GraphStage& stage : stages) {
    if (stage.ports.outputs[index_of(topic)]) return &stage;
  }
  return nullptr;
}

std::vector<const GraphStage*> Graph::readers_of(Topic topic) const {
  std::vector<const GraphStage*> readers;
  for (const GraphStage& stage : stages) {
    if (stage.ports.all_inputs()[index_of(topic)]) readers.push_back(&stage);
  }
  return readers;
}

Result<Graph> load_graph(const core::Resource& file, const std::string& name,
                         const GraphOverrides& overrides, const std::vector<StageInfo>& stages) {
  auto raw = read_raw_graph(file, name, stages);
  if (!raw.ok()) return raw.error();
  CLEW_RETURN_IF_ERROR(apply_overrides(overrides, *raw));
  Graph graph = raw->head;
  for (RawStage& stage : raw->stages) {
    auto resolved = resolve_stage(std::move(stage));
    if (!resolved.ok()) return resolved.error();
    graph.stages.push_back(std::move(resolved).value());
  }
  CLEW_RETURN_IF_ERROR(wire(graph));
  CLEW_RETURN_IF_ERROR(settle_tick(stages, graph));
  CLEW_RETURN_IF_ERROR(check_groups(stages, graph));
  return graph;
}

}  // namespace clew::runtime

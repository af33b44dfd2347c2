// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/yaml_reader.hpp"
#include "runtime/graph.hpp"

namespace clew::runtime {

/// A parameter as given: in the file, or by --set.
struct RawParameter {
  std::string name;
  core::YamlNode where;  ///< the key
  core::YamlNode value;
  bool by_option = false;
};

/// A behaviour as named: in the file, or by --with.
struct RawChoice {
  std::string name;
  core::YamlNode where;
  std::vector<RawParameter> parameters;
};

/// A stage as written, its keys sorted out but not yet checked.
struct RawStage {
  const StageInfo* info = nullptr;
  core::YamlNode where;
  std::map<std::string, std::vector<RawChoice>> parts;
  std::vector<RawParameter> parameters;  ///< of the stage, or of its `behaviour`
  Deployment deployment;
  std::set<std::string> parts_by_option = {};
};

/// Where a value stands.
Place place_of(const core::YamlNode& node);

struct RawGraph {
  Graph head;  ///< without stages
  core::YamlNode where;
  std::vector<RawStage> stages;  ///< in the order of the declarations
};

core::Result<RawGraph> read_raw_graph(const core::Resource& file, const std::string& name,
                                      const std::vector<StageInfo>& stages);
/// The names of the settings of a stage's `process`.
const std::vector<std::string>& process_settings();
/// Reads one of them.
core::Result<void> read_process_setting(const std::string& key, const core::YamlNode& value,
                                        Deployment& deployment);
core::Result<void> apply_overrides(const GraphOverrides& overrides, RawGraph& graph);

/// The values of declared parameters: given ones, checked, else defaults. What is given but not
/// declared is an error that calls the owner `owner`.
core::Result<core::ParameterValues> resolve_parameters(
    const std::vector<core::ParameterInfo>& infos, const std::vector<RawParameter>& given,
    const std::string& owner);

/// Whether a parameter of that name is among them.
bool declares(const std::vector<core::ParameterInfo>& infos, const std::string& name);
/// The part of that name, or null.
const PartInfo* find_part(const StageInfo& stage, const std::string& name);
/// The variant of that name, or an error that lists the known ones.
core::Result<const VariantInfo*> find_variant(const StageInfo& stage, const PartInfo& part,
                                              const RawChoice& choice);

/// The part whose name and parameters stand directly in the stage's map.
inline constexpr char kBehaviourPart[] = "behaviour";

}  // namespace clew::runtime

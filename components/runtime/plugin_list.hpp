// SPDX-License-Identifier: Apache-2.0
/// The plug-ins of this process. As behaviours are, they are known to the whole process and stay.
#pragma once

#include <string>
#include <vector>

#include "core/resources.hpp"
#include "core/result.hpp"
#include "core/yaml_reader.hpp"
#include "runtime/graph.hpp"

namespace clew::runtime {

/// A behaviour's place: the stage, its part and the name.
struct BehaviourName {
  std::string stage;
  std::string part;
  std::string name;
};

/// A plug-in that is loaded.
struct PluginInfo {
  std::string name;
  std::string version;
  std::string file;    ///< an absolute path
  std::string digest;  ///< of the file, 32 hexadecimal digits
  std::vector<BehaviourName> behaviours;
};

/// In the order in which they were loaded.
const std::vector<PluginInfo>& loaded_plugins();
/// Null if there is none of that name.
const PluginInfo* find_plugin(const std::string& name);
/// The one that a behaviour comes from; null for ours.
const PluginInfo* plugin_of(const BehaviourName& behaviour);
/// For who has loaded it.
void note_plugin(PluginInfo plugin);

/// A plug-in as a graph names it.
struct NamedPlugin {
  std::string name;
  std::string digest;  ///< that it had when the graph was recorded; empty in a graph file
  Place place;
};

/// What stands under `plugins` in a graph: names, or maps of `name` and `digest`.
core::Result<std::vector<NamedPlugin>> read_plugins(const core::YamlNode& graph);
/// The same of a graph's text.
core::Result<std::vector<NamedPlugin>> read_plugins(const core::Resource& graph);
/// Refused: a graph that names a plug-in that is not loaded.
core::Result<void> check_plugins(const core::YamlNode& graph);
/// The plug-ins that the chosen behaviours come from, as `plugins` of a graph; empty if all are
/// ours.
std::string plugins_text(const Graph& graph);

/// Where names are looked up: the directory that `program` is installed with, then CLEW_PATH.
std::vector<std::string> config_roots(const std::string& program = "/proc/self/exe");

}  // namespace clew::runtime

// SPDX-License-Identifier: Apache-2.0
#include "runtime/plugin_list.hpp"

#include <algorithm>
#include <utility>

#include "runtime/raw_graph.hpp"

namespace clew::runtime {
namespace {

std::vector<PluginInfo>& plugins() {
  static std::vector<PluginInfo> loaded;
  return loaded;
}

core::Result<NamedPlugin> read_plugin(const core::YamlNode& node) {
  NamedPlugin plugin{{}, {}, place_of(node)};
  if (node.kind() != core::YamlKind::kMap) {
    auto name = node.string();
    if (!name.ok()) return name.error();
    plugin.name = std::move(name).value();
    return plugin;
  }
  CLEW_RETURN_IF_ERROR(node.check_keys({"name", "version", "digest"}));
  const auto text = [&node](const char* key, std::string& field) -> core::Result<void> {
    const auto found = node.at(key);
    if (!found.ok()) return found.error();
    auto value = found->string();
    if (!value.ok()) return value.error();
    field = std::move(value).value();
    return {};
  };
  CLEW_RETURN_IF_ERROR(text("name", plugin.name));
  CLEW_RETURN_IF_ERROR(text("digest", plugin.digest));
  return plugin;
}

}  // namespace

const std::vector<PluginInfo>& loaded_plugins() { return plugins(); }

const PluginInfo* find_plugin(const std::string& name) {
  for (const PluginInfo& plugin : plugins()) {
    if (plugin.name == name) return &plugin;
  }
  return nullptr;
}

const PluginInfo* plugin_of(const BehaviourName& behaviour) {
  for (const PluginInfo& plugin : plugins()) {
    for (const BehaviourName& own : plugin.behaviours) {
      if (own.stage == behaviour.stage && own.part == behaviour.part &&
          own.name == behaviour.name) {
        return &plugin;
      }
    }
  }
  return nullptr;
}

void note_plugin(PluginInfo plugin) { plugins().push_back(std::move(plugin)); }

core::Result<std::vector<NamedPlugin>> read_plugins(const core::YamlNode& graph) {
  std::vector<NamedPlugin> named;
  const auto node = graph.find("plugins");
  if (!node) return named;
  const auto items = node->items();
  if (!items.ok()) return items.error();
  for (const core::YamlNode& item : *items) {
    auto plugin = read_plugin(item);
    if (!plugin.ok()) return plugin.error();
    named.push_back(std::move(plugin).value());
  }
  return named;
}

core::Result<std::vector<NamedPlugin>> read_plugins(const core::Resource& graph) {
  const auto root = core::YamlNode::parse(graph.text, graph.file);
  if (!root.ok()) return root.error();
  return read_plugins(*root);
}

core::Result<void> check_plugins(const core::YamlNode& graph) {
  const auto named = read_plugins(graph);
  if (!named.ok()) return named.error();
  for (const NamedPlugin& plugin : *named) {
    // A graph file may name one by its path, which is loaded by then, under its own name.
    const bool is_path = plugin.name.find('/') != std::string::npos;
    if (is_path || find_plugin(plugin.name) != nullptr) continue;
    return plugin.place.error("needs the plug-in '" + plugin.name + "'" +
                              (plugin.digest.empty() ? "" : " (digest " + plugin.digest + ")") +
                              ", which is not loaded; give it with --plugin " + plugin.name +
                              " or --plugin PATH");
  }
  return {};
}

std::string plugins_text(const Graph& graph) {
  std::vector<const PluginInfo*> used;
  for (const GraphStage& stage : graph.stages) {
    for (const auto& [part, choices] : stage.config.parts) {
      for (const PartChoice& choice : choices) {
        const PluginInfo* plugin = plugin_of({stage.info->name, part, choice.name});
        const bool is_new = std::find(used.begin(), used.end(), plugin) == used.end();
        if (plugin != nullptr && is_new) used.push_back(plugin);
      }
    }
  }
  std::string text;
  for (const PluginInfo* plugin : used) {
    text += "  - {name: \"" + plugin->name + "\", version: \"" + plugin->version +
            "\", digest: \"" + plugin->digest + "\"}\n";
  }
  return text.empty() ? text : "plugins:\n" + text;
}

}  // namespace clew::runtime

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "clew/parameter_table.hpp"
#include "clew/plugin_options.hpp"
#include "core/nearest_name.hpp"
#include "core/yaml_reader.hpp"
#include "runtime/config_source.hpp"
#include "runtime/on_demand.hpp"
#include "runtime/plugin_list.hpp"
#include "runtime/stage.hpp"
#include "stages/all.hpp"

namespace clew::tools {
namespace {

struct ListOptions {
  std::string what;  ///< `graphs`, `worlds`, a stage, or `STAGE.PART`; empty: what there is
  std::string name;
  std::vector<std::string> plugins;
  bool markdown = false;  ///< tables for a README
};

using runtime::PartInfo;
using runtime::PortInfo;
using runtime::StageInfo;
using runtime::VariantInfo;

/// Those of configs/ that have names to choose from.
const std::vector<std::string> kFolders = {"graphs", "worlds",    "suites",  "robots",
                                           "maps",   "rulebases", "training"};

void print_parameters(const std::vector<core::ParameterInfo>& infos) {
  for (const core::ParameterInfo& info : infos) {
    const std::string unit = info.unit.empty() || info.unit == "1" ? "" : ' ' + info.unit;
    const std::string allowed = allowed_text(info);
    fmt::print("    {} = {}{}{}  {}\n", info.name, default_text(info), unit,
               allowed.empty() ? "" : " (" + allowed + ")", info.doc);
  }
}

void print_port(const PortInfo& port) {
  std::string kind = port.direction == PortInfo::Direction::kOutput ? "out" : "in";
  if (port.need == PortInfo::Need::kOptional) kind += ", optional";
  if (runtime::is_on_demand(port)) {
    kind += ", if a behaviour needs it";
  } else if (port.need == PortInfo::Need::kFallback) {
    kind += port.direction == PortInfo::Direction::kOutput
                ? ", if no other stage writes it"
                : ", if there is no " + std::string(domain::topic_name(port.instead_of));
  }
  if (port.delayed) kind += ", of the tick before";
  fmt::print("    {} ({}, {})  {}\n", domain::topic_name(port.topic), kind,
             domain::type_name(port.topic), port.doc);
}

void print_variant(const StageInfo& stage, const PartInfo& part, const VariantInfo& variant) {
  const auto* plugin = runtime::plugin_of({stage.name, part.name, variant.name});
  const std::string from = plugin == nullptr ? "" : " (plug-in " + plugin->name + ')';
  fmt::print("  {}.{} {}{}: {}\n", stage.name, part.name, variant.name, from, variant.summary);
  print_parameters(variant.parameters);
}

// The parameters of a stage itself, or of one behaviour, as a table.
int print_table(const StageInfo& stage, const std::string& part_name, const std::string& name) {
  if (name.empty()) {
    fmt::print("{}", parameter_table(stage.parameters));
    return kExitGood;
  }
  for (const PartInfo& part : stage.parts) {
    if (!part_name.empty() && part.name != part_name) continue;
    for (const VariantInfo& variant : part.variants) {
      if (variant.name != name) continue;
      fmt::print("{}", parameter_table(variant.parameters));
      return kExitGood;
    }
  }
  return complain(
      {"found '" + name + "'; allowed: a behaviour that `clew list " + stage.name + "` names",
       "--markdown", 0, 0});
}

int list_files(const std::string& folder, const std::string& name) {
  const auto path = runtime::ConfigPath::from_environment();
  for (const std::string& known : path.names(folder)) {
    if (!name.empty() && known != name) continue;
    const auto file = path.find(folder, known);
    if (!file.ok()) return complain(file.error());
    if (!name.empty()) {
      fmt::print("{}", file->text);
      return kExitGood;
    }
    std::string about;
    const auto root = core::YamlNode::parse(file->text, file->file);
    if (root.ok()) {
      if (const auto node = root->find("about")) about = node->string().ok() ? *node->string() : "";
    }
    fmt::print("{:<32} {}\n", known, about);
  }
  if (name.empty()) return kExitGood;
  return complain(path.find(folder, name).error());
}

int list_stage(const StageInfo& stage, const std::string& part_name, const std::string& name) {
  std::vector<std::string> parts;
  std::vector<std::string> names;
  bool found = false;
  if (part_name.empty() && name.empty()) {
    fmt::print("{}: {}\n  ports:\n", stage.name, stage.summary);
    for (const PortInfo& port : stage.ports) print_port(port);
    if (!stage.parameters.empty()) fmt::print("  parameters of every {}:\n", stage.name);
    print_parameters(stage.parameters);
  }
  for (const PartInfo& part : stage.parts) {
    parts.push_back(part.name);
    if (!part_name.empty() && part.name != part_name) continue;
    for (const VariantInfo& variant : part.variants) {
      names.push_back(variant.name);
      if (!name.empty() && variant.name != name) continue;
      found = true;
      print_variant(stage, part, variant);
    }
  }
  if (found) return kExitGood;
  if (names.empty()) {
    return complain({core::unknown_name("part of " + stage.name, part_name, parts), {}, 0, 0});
  }
  return complain({core::unknown_name("behaviour of " + stage.name, name, names), {}, 0, 0});
}

int list_all() {
  fmt::print("{}, or a stage:\n", fmt::join(kFolders, ", "));
  for (const StageInfo& stage : stages::all()) {
    fmt::print("  {:<9} {}\n", stage.name, stage.summary);
  }
  return kExitGood;
}

int list_command(const ListOptions& options) {
  const auto plugins = load_plugins_of(options.plugins);
  if (!plugins.ok()) return complain(plugins.error());
  if (options.what.empty()) return list_all();
  std::vector<std::string> known = kFolders;
  if (std::find(known.begin(), known.end(), options.what) != known.end()) {
    return list_files(options.what, options.name);
  }
  const std::size_t dot = options.what.find('.');
  const std::string stage_name = options.what.substr(0, dot);
  for (const StageInfo& stage : stages::all()) {
    if (stage.name == stage_name) {
      const std::string part = dot == std::string::npos ? "" : options.what.substr(dot + 1);
      return options.markdown ? print_table(stage, part, options.name)
                              : list_stage(stage, part, options.name);
    }
    known.push_back(stage.name);
  }
  return complain({core::unknown_name("list", stage_name, known), {}, 0, 0});
}

}  // namespace

void add_list(CLI::App& main, int& status) {
  const auto options = std::make_shared<ListOptions>();
  CLI::App* app = main.add_subcommand(
      "list", "List what there is: graphs, worlds, suites, stages, behaviours, ...");
  app->add_option("what", options->what,
                  "graphs | worlds | suites | robots | maps | rulebases | training | STAGE[.PART]");
  app->add_option("name", options->name, "only this one");
  add_plugins(*app, options->plugins);
  app->add_flag("--markdown", options->markdown,
                "the parameters of a stage, or of the behaviour NAME, as a table for a README");
  app->callback([options, &status] { status = list_command(*options); });
}

}  // namespace clew::tools

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "clew/json_line.hpp"
#include "clew/list_json.hpp"
#include "clew/parameter_table.hpp"
#include "clew/plugin_options.hpp"
#include "clew/print_text.hpp"
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
  bool json = false;
  bool names = false;  ///< and nothing else, one a line
};

using nlohmann::ordered_json;
using runtime::PartInfo;
using runtime::PortInfo;
using runtime::StageInfo;
using runtime::VariantInfo;

/// Those of configs/ that have names to choose from.
const std::vector<std::string> kFolders = {"graphs", "fleets", "worlds",    "suites",
                                           "robots", "maps",   "rulebases", "training"};
constexpr char kTopics[] = "topics";

void print_parameters(const std::vector<core::ParameterInfo>& infos) {
  for (const core::ParameterInfo& info : infos) {
    const std::string unit = info.unit.empty() || info.unit == "1" ? "" : ' ' + info.unit;
    const std::string allowed = allowed_text(info);
    print_text("    {} = {}{}{}  {}\n", info.name, default_text(info), unit,
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
  print_text("    {} ({}, {})  {}\n", domain::topic_name(port.topic), kind,
             domain::type_name(port.topic), port.doc);
}

void print_variant(const StageInfo& stage, const PartInfo& part, const VariantInfo& variant) {
  const auto* plugin = runtime::plugin_of({stage.name, part.name, variant.name});
  const std::string from = plugin == nullptr ? "" : " (plug-in " + plugin->name + ')';
  print_text("  {}.{} {}{}: {}\n", stage.name, part.name, variant.name, from, variant.summary);
  print_parameters(variant.parameters);
}

// The parameters of a stage itself, or of one behaviour, as a table.
int print_table(const StageInfo& stage, const std::string& part_name, const std::string& name) {
  if (name.empty()) {
    print_text("{}", parameter_table(stage.parameters));
    return kExitGood;
  }
  for (const PartInfo& part : stage.parts) {
    if (!part_name.empty() && part.name != part_name) continue;
    for (const VariantInfo& variant : part.variants) {
      if (variant.name != name) continue;
      print_text("{}", parameter_table(variant.parameters));
      return kExitGood;
    }
  }
  return complain(
      {"found '" + name + "'; allowed: a behaviour that `clew list " + stage.name + "` names",
       "--markdown", 0, 0});
}

std::string about_of(const core::Resource& file) {
  const auto root = core::YamlNode::parse(file.text, file.file);
  if (!root.ok()) return "";
  const auto node = root->find("about");
  return node && node->string().ok() ? *node->string() : "";
}

int list_files(const ListOptions& options) {
  const auto path = runtime::ConfigPath::from_environment();
  for (const std::string& known : path.names(options.what)) {
    if (!options.name.empty() && known != options.name) continue;
    const auto file = path.find(options.what, known);
    if (!file.ok()) return complain(file.error());
    if (options.json) {
      ordered_json json = {{"name", known}, {"file", file->file}, {"about", about_of(*file)}};
      if (!options.name.empty()) json["text"] = file->text;
      print_text("{}\n", json_line(json));
    } else if (options.names) {
      print_text("{}\n", known);
    } else if (options.name.empty()) {
      print_text("{:<32} {}\n", known, about_of(*file));
    } else {
      print_text("{}", file->text);
    }
    if (!options.name.empty()) return kExitGood;
  }
  if (options.name.empty()) return kExitGood;
  return complain(path.find(options.what, options.name).error());
}

int list_topics(const ListOptions& options) {
  std::vector<std::string> known;
  bool found = false;
  for (const ordered_json& topic : json_of_topics()) {
    const auto name = topic["topic"].get<std::string>();
    known.push_back(name);
    if (!options.name.empty() && name != options.name) continue;
    found = true;
    if (options.json) {
      print_text("{}\n", json_line(topic));
    } else if (options.names) {
      print_text("{}\n", name);
    } else {
      const auto words = [&](const char* key) {
        return fmt::format("{}", fmt::join(topic[key].get<std::vector<std::string>>(), ", "));
      };
      print_text("{:<9} {:<22} {} to {}\n", name, topic["type"].get<std::string>(),
                 words("writers"), words("readers"));
    }
  }
  if (found) return kExitGood;
  return complain({core::unknown_name("topic", options.name, known), {}, 0, 0});
}

/// The behaviours that fit, or an error that names those that there are.
core::Result<void> check_choice(const StageInfo& stage, const std::string& part_name,
                                const std::string& name) {
  std::vector<std::string> parts;
  std::vector<std::string> names;
  for (const PartInfo& part : stage.parts) {
    parts.push_back(part.name);
    if (!part_name.empty() && part.name != part_name) continue;
    for (const VariantInfo& variant : part.variants) names.push_back(variant.name);
  }
  if (names.empty()) {
    return core::Error{core::unknown_name("part of " + stage.name, part_name, parts)};
  }
  if (name.empty() || std::find(names.begin(), names.end(), name) != names.end()) return {};
  return core::Error{core::unknown_name("behaviour of " + stage.name, name, names)};
}

int list_stage(const StageInfo& stage, const std::string& part_name, const ListOptions& options) {
  const auto checked = check_choice(stage, part_name, options.name);
  if (!checked.ok()) return complain(checked.error());
  if (options.json) {
    print_text("{}\n", json_line(json_of(stage, part_name, options.name)));
    return kExitGood;
  }
  const bool whole = part_name.empty() && options.name.empty() && !options.names;
  if (whole) {
    print_text("{}: {}\n  ports:\n", stage.name, stage.summary);
    for (const PortInfo& port : stage.ports) print_port(port);
    if (!stage.parameters.empty()) print_text("  parameters of every {}:\n", stage.name);
    print_parameters(stage.parameters);
  }
  for (const PartInfo& part : stage.parts) {
    if (!part_name.empty() && part.name != part_name) continue;
    for (const VariantInfo& variant : part.variants) {
      if (!options.name.empty() && variant.name != options.name) continue;
      if (options.names) {
        print_text("{}\n", variant.name);
      } else {
        print_variant(stage, part, variant);
      }
    }
  }
  return kExitGood;
}

int list_all(const ListOptions& options) {
  std::vector<std::string> folders = kFolders;
  folders.emplace_back(kTopics);
  if (!options.json && !options.names) print_text("{}, or a stage:\n", fmt::join(folders, ", "));
  if (options.names) print_text("{}\n", fmt::join(folders, "\n"));
  ordered_json all = ordered_json::array();
  for (const StageInfo& stage : stages::all()) {
    all.push_back({{"stage", stage.name}, {"about", stage.summary}});
    if (options.names) print_text("{}\n", stage.name);
    if (!options.json && !options.names) print_text("  {:<9} {}\n", stage.name, stage.summary);
  }
  if (options.json) print_text("{}\n", json_line({{"lists", folders}, {"stages", all}}));
  return kExitGood;
}

int list_command(const ListOptions& options) {
  const auto plugins = load_plugins_of(options.plugins);
  if (!plugins.ok()) return complain(plugins.error());
  if (options.what.empty()) return list_all(options);
  if (options.what == kTopics) return list_topics(options);
  std::vector<std::string> known = kFolders;
  if (std::find(known.begin(), known.end(), options.what) != known.end()) {
    return list_files(options);
  }
  known.emplace_back(kTopics);
  const std::size_t dot = options.what.find('.');
  const std::string stage_name = options.what.substr(0, dot);
  for (const StageInfo& stage : stages::all()) {
    if (stage.name == stage_name) {
      const std::string part = dot == std::string::npos ? "" : options.what.substr(dot + 1);
      return options.markdown ? print_table(stage, part, options.name)
                              : list_stage(stage, part, options);
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
                  "graphs | worlds | suites | robots | maps | rulebases | training | topics | "
                  "STAGE[.PART]");
  app->add_option("name", options->name, "only this one");
  add_plugins(*app, options->plugins);
  app->add_flag("--markdown", options->markdown,
                "the parameters of a stage, or of the behaviour NAME, as a table for a README");
  auto* json = app->add_flag("--json", options->json, "an object a line; of a stage, one object");
  app->add_flag("--names", options->names, "names only, one a line")->excludes(json);
  app->callback([options, &status] { status = list_command(*options); });
}

}  // namespace clew::tools

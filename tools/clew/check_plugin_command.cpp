// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "clew/json_line.hpp"
#include "contract/behaviour_contract.hpp"
#include "contract/own_process.hpp"
#include "plugins/plugin_file.hpp"
#include "plugins/plugin_loader.hpp"
#include "runtime/config_source.hpp"

namespace clew::tools {
namespace {

using core::Result;

constexpr unsigned kTimeout_s = 60;

struct CheckPluginOptions {
  std::string file;
  bool json = false;
};

void print(const CheckPluginOptions& options, const std::string& behaviour, const std::string& rule,
           const Result<void>& kept) {
  const std::string found = kept.ok() ? "" : kept.error().text();
  if (options.json) {
    fmt::print(
        "{}\n",
        json_line(
            {{"behaviour", behaviour}, {"check", rule}, {"ok", kept.ok()}, {"found", found}}));
  } else {
    fmt::print("  {:<17} {}\n", rule, kept.ok() ? "good" : "BROKEN: " + found);
  }
}

bool check_behaviour(const CheckPluginOptions& options, const runtime::BehaviourName& behaviour,
                     const runtime::ConfigPath& configs) {
  const std::string name = behaviour.stage + '.' + behaviour.part + ' ' + behaviour.name;
  if (!options.json) fmt::print("{}\n", name);
  // Making it is the first thing that may go wrong.
  const auto made = contract::in_own_process(
      [&]() -> Result<void> {
        const auto found = contract::find_graph(behaviour, configs);
        if (!found.ok()) return found.error();
        return {};
      },
      kTimeout_s);
  if (!made.ok()) {
    print(options, name, "fits", made);
    return false;
  }
  const auto found = contract::find_graph(behaviour, configs);
  if (!found.ok()) return false;
  bool all_kept = true;
  for (const contract::Rule& rule : contract::rules()) {
    const auto kept = contract::in_own_process([&] { return rule.check(*found); }, kTimeout_s);
    all_kept = all_kept && kept.ok();
    print(options, name, rule.name, kept);
  }
  return all_kept;
}

int check_plugin_command(const CheckPluginOptions& options) {
  const auto path = bridge::find_plugin_file(options.file, runtime::config_roots());
  if (!path.ok()) return complain(path.error());
  const auto loaded = bridge::load_plugin(*path);
  if (!loaded.ok()) return complain(loaded.error());
  const auto configs = runtime::ConfigPath::from_environment();
  bool good = true;
  for (const runtime::PluginInfo& plugin : runtime::loaded_plugins()) {
    if (!options.json) {
      fmt::print("plug-in {} {}, digest {}\n", plugin.name, plugin.version, plugin.digest);
    }
    for (const runtime::BehaviourName& behaviour : plugin.behaviours) {
      good = check_behaviour(options, behaviour, configs) && good;
    }
  }
  return good ? kExitGood : kExitFailed;
}

}  // namespace

void add_check_plugin(CLI::App& main, int& status) {
  const auto options = std::make_shared<CheckPluginOptions>();
  CLI::App* app = main.add_subcommand(
      "check-plugin", "Check that the behaviours of a plug-in keep the rules that ours keep");
  app->add_option("file", options->file, "the library: a path with a slash, or a name")->required();
  app->add_flag("--json", options->json, "print one JSON object a check");
  app->callback([options, &status] { status = check_plugin_command(*options); });
}

}  // namespace clew::tools

// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "clew/command_line.hpp"
#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "clew/plugin_options.hpp"
#include "plot/plot.hpp"
#include "rules/rule_base.hpp"
#include "rules/rule_picture.hpp"
#include "runtime/run_plan.hpp"
#include "stages/all.hpp"

namespace clew::tools {
namespace {

struct RulesOptions {
  std::string graph;
  runtime::GraphOverrides overrides;
  std::vector<std::string> plugins;
  std::string output;
  bool json = false;
};

int rules_command(const RulesOptions& options) {
  const auto plugins = load_plugins_of(options.plugins, options.graph);
  if (!plugins.ok()) return complain(plugins.error());
  const auto plan = runtime::prepare_run(options.graph, options.overrides,
                                         runtime::ConfigPath::from_environment(), stages::all());
  if (!plan.ok()) return complain(plan.error());
  const auto bases = rules::rule_bases_of(*plan);
  if (!bases.ok()) return complain(bases.error());
  if (bases->fuzzy.empty()) {
    return complain({fmt::format("graph {} has no fuzzy rule base", plan->graph.name), {}, 0, 0},
                    kExitFailed);
  }
  if (!options.output.empty()) {
    const auto drawn =
        plot::write_picture(rules::draw(plan->graph.name, bases->fuzzy), options.output);
    return drawn.ok() ? kExitGood : complain(drawn.error());
  }
  for (const rules::RuleBase& base : bases->fuzzy) {
    fmt::print("{}\n", options.json ? rules::to_json(base) : rules::describe(base));
  }
  if (options.json) return kExitGood;
  for (const std::string& other : bases->others) {
    fmt::print("rulebases/{} has no fuzzy sets\n", other);
  }
  return kExitGood;
}

}  // namespace

void add_rules(CLI::App& main, int& status) {
  const auto options = std::make_shared<RulesOptions>();
  CLI::App* app = main.add_subcommand("rules", "Show the fuzzy sets and rules of a graph");
  app->add_option("graph", options->graph, "a name or a path")->required();
  add_overrides(*app, options->overrides);
  add_plugins(*app, options->plugins);
  app->add_option("-o,--output", options->output,
                  "draw sets and control surfaces instead: .svg, .png or .pdf")
      ->check(given_name());
  app->add_flag("--json", options->json, "print one JSON object a rule base, with every value");
  app->callback([options, &status] { status = rules_command(*options); });
}

}  // namespace clew::tools

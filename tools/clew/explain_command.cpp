// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "clew/command_line.hpp"
#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "clew/json_line.hpp"
#include "clew/plugin_options.hpp"
#include "clew/print_text.hpp"
#include "insides/explanation.hpp"
#include "insides/inside_json.hpp"
#include "replay/recorded_plan.hpp"
#include "stages/all.hpp"

namespace clew::tools {
namespace {

constexpr std::size_t kColumns = 88;

struct ExplainOptions {
  std::string recording;
  std::uint64_t tick = 0;
  std::optional<std::string> component;
  std::vector<std::string> plugins;
  bool json = false;
};

core::Result<std::vector<insides::Explanation>> read_explanations(const ExplainOptions& options) {
  const auto recording = bridge::RunRecording::open(options.recording);
  if (!recording.ok()) return recording.error();
  CLEW_RETURN_IF_ERROR(load_plugins_for(*recording, options.plugins));
  const auto plan = bridge::recorded_plan(*recording, stages::all());
  if (!plan.ok()) return plan.error();
  return insides::explain(*recording, *plan, options.tick, options.component);
}

int explain_command(const ExplainOptions& options) {
  const auto explanations = read_explanations(options);
  if (!explanations.ok()) return complain(explanations.error());
  bool first = true;
  for (const insides::Explanation& each : *explanations) {
    if (options.json) {
      print_text("{}\n", json_line({{"stage", each.stage},
                                    {"behaviour", each.behaviour},
                                    {"tick", options.tick},
                                    {"text", each.inside.text},
                                    {"inside", insides::to_json(each.inside.values)},
                                    {"picture", insides::to_json(each.inside.picture)}}));
      continue;
    }
    print_text(
        "{}{}\n", first ? "" : "\n",
        insides::wrapped(fmt::format("{} ({}): {}", each.stage, each.behaviour, each.inside.text),
                         kColumns));
    first = false;
  }
  return kExitGood;
}

}  // namespace

void add_explain(CLI::App& main, int& status) {
  const auto options = std::make_shared<ExplainOptions>();
  CLI::App* app = main.add_subcommand(
      "explain", "Say in words what each component saw, weighed and decided at a tick");
  app->add_option("recording", options->recording, "of a run")->required();
  app->add_option("--tick", options->tick, "the tick to explain")
      ->required()
      ->check(whole_number());
  app->add_option("--component", options->component, "this stage alone");
  add_plugins(*app, options->plugins);
  app->add_flag("--json", options->json,
                "print one JSON object a stage, with all values behind the words");
  app->callback([options, &status] { status = explain_command(*options); });
}

}  // namespace clew::tools

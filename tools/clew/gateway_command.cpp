// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "clew/command_line.hpp"
#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "clew/json_line.hpp"
#include "clew/own_program.hpp"
#include "clew/plugin_options.hpp"
#include "clew/typed_line.hpp"
#include "files/scratch_folder.hpp"
#include "files/whole_file.hpp"
#include "gateway/gateway_process.hpp"
#include "plugins/plugin_loader.hpp"
#include "runtime/config_source.hpp"
#include "runtime/graph.hpp"
#include "runtime/intervention.hpp"
#include "stages/all.hpp"
#include "view/page_file.hpp"
#include "view/page_order.hpp"
#include "view/registry_json.hpp"
#include "view/what_if.hpp"

namespace clew::tools {
namespace {

using bridge::RunCommand;

RunCommand::Kind kind_of(const std::string& order) {
  static const std::map<std::string, RunCommand::Kind> kKinds = {
      {"pause", RunCommand::Kind::kPause},
      {"step", RunCommand::Kind::kStep},
      {"resume", RunCommand::Kind::kResume},
      {"stop", RunCommand::Kind::kStop},
      {"pace", RunCommand::Kind::kPace}};
  const auto found = kKinds.find(order);
  return found == kKinds.end() ? RunCommand::Kind::kChange : found->second;
}

/// Rule bases that were written on the page, as files that the run reads.
class RuleFiles {
 public:
  explicit RuleFiles(files::ScratchFolder folder) : folder_(std::move(folder)) {}

  core::Result<std::string> write(const std::string& text) {
    const std::string file = folder_.path() + "/rules-" + std::to_string(++count_) + ".yaml";
    CLEW_RETURN_IF_ERROR(files::write_file(file, text));
    return file;
  }

 private:
  files::ScratchFolder folder_;
  int count_ = 0;
};

core::Result<bridge::PageCommandLine> read_command(const std::string& body, const std::string& run,
                                                   RuleFiles& rules) {
  auto order = view::read_order(body, stages::all());
  if (!order.ok()) return order.error();
  for (const view::EditedRules& edited : order->rules) {
    const auto file = rules.write(edited.text);
    if (!file.ok()) return file.error();
    order->changes.push_back(edited.place + '=' + *file);
    order->words.push_back("--set=" + order->changes.back());
  }
  RunCommand command{kind_of(order->order)};
  command.changes = order->changes;
  command.ticks = order->ticks;
  command.pace_factor = order->pace_factor;
  std::vector<std::string> words = {order->order, run};
  words.insert(words.end(), order->words.begin(), order->words.end());
  return bridge::PageCommandLine{std::move(command), typed_line(words)};
}

core::Result<bridge::PageQuestion> read_question(const std::string& body) {
  const auto question = view::read_question(body, 1);
  if (!question.ok()) return question.error();
  std::vector<std::string> words = {"explain", "RECORDING"};
  words.insert(words.end(), question->words.begin(), question->words.end());
  return bridge::PageQuestion{question->tick, typed_line(words)};
}

/// Our own stages: nobody knows the state of someone else's component.
std::size_t count_stages(const bridge::RunDescription& description) {
  const auto file = runtime::BundleSource(description.bundle).find("graphs", "graph");
  if (!file.ok()) return 0;
  const auto graph = runtime::load_graph(*file, "graph", {}, stages::all());
  if (!graph.ok()) return 0;
  return static_cast<std::size_t>(
      std::count_if(graph->stages.begin(), graph->stages.end(),
                    [](const auto& stage) { return stage.deployment.is_ours(); }));
}

core::Result<runtime::Bundle> changed_texts(const bridge::RunDescription& description,
                                            const std::vector<domain::Intervention>& changes) {
  return runtime::changed_bundle(description.bundle, changes, stages::all());
}

struct Ends {
  int socket = -1;
  int port = 0;
  std::vector<std::string> plugins;
};

int gateway_command(const Ends& ends) {
  const auto loaded = bridge::load_plugins(ends.plugins);
  if (!loaded.ok()) return complain(loaded.error());
  std::vector<std::string> explain = {own_program(), "explain"};
  for (const std::string& plugin : ends.plugins) {
    explain.insert(explain.end(), {"--plugin", plugin});
  }
  auto folder = files::ScratchFolder::make("clew-rules");
  if (!folder.ok()) return complain(folder.error(), kExitFailed);
  RuleFiles rules(std::move(folder).value());
  const auto read = [&rules](const std::string& body, const std::string& run) {
    return read_command(body, run, rules);
  };
  const bridge::GatewayPage page{view::page(),
                                 json_line({{"stages", view::registry_json(stages::all())},
                                            {"graphs", nlohmann::ordered_json::array()},
                                            {"worlds", nlohmann::ordered_json::array()}}),
                                 read,
                                 read_question,
                                 count_stages,
                                 changed_texts,
                                 explain};
  return bridge::run_gateway_process(ends.socket, ends.port, page);
}

}  // namespace

void add_gateway(CLI::App& main, int& status) {
  const auto ends = std::make_shared<Ends>();
  CLI::App* app = main.add_subcommand("gateway", "Serve the page of a run as this process");
  app->group("");
  app->add_option("--socket", ends->socket, "to the run")->required();
  app->add_option("--port", ends->port, "of 127.0.0.1")->required();
  add_plugins(*app, ends->plugins);
  app->callback([ends, &status] { status = gateway_command(*ends); });
}

}  // namespace clew::tools

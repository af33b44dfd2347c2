// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>

#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "clew/commands.hpp"
#include "clew/exit_status.hpp"
#include "component/component_process.hpp"
#include "core/nearest_name.hpp"
#include "dds/rtps_ports.hpp"
#include "recorder/recorder_process.hpp"
#include "robot/robots.hpp"
#include "runtime/run_plan.hpp"
#include "stages/all.hpp"

namespace clew::tools {
namespace {

struct ComponentOptions {
  std::string graph;  ///< `-`: as the run has it
  std::string stage;
  std::optional<int> domain;
  std::optional<int> line;           ///< of a host, which starts it for a run elsewhere
  std::vector<std::string> allowed;  ///< with line
};

using core::Error;
using core::Result;

// A person may start the component first and the run afterwards.
constexpr double kConnectTimeout_s = 60.0;

// The run decides the configuration; a graph that is named must at least be one with the stage.
Result<void> check_graph(const ComponentOptions& options) {
  const auto plan = runtime::prepare_run(options.graph, {}, runtime::ConfigPath::from_environment(),
                                         stages::all());
  if (!plan.ok()) return plan.error();
  std::vector<std::string> known;
  for (const auto& stage : plan->graph.stages) {
    if (stage.info->name == options.stage || stage.deployment.group == options.stage) return {};
    known.push_back(stage.info->name);
  }
  return Error{core::unknown_name("stage of this graph", options.stage, known), options.graph};
}

Result<int> read_domain(const ComponentOptions& options) {
  const char* const variable = "CLEW_DOMAIN_ID";
  int domain = 0;
  if (options.domain) {
    domain = *options.domain;
  } else if (const char* text = std::getenv(variable)) {
    const char* const end = text + std::strlen(text);
    const auto [stop, error] = std::from_chars(text, end, domain);
    if (error != std::errc() || stop != end) {
      return Error{"found '" + std::string(text) + "', expected the number of a DDS domain",
                   variable};
    }
  } else {
    return Error{"which run? give --domain, or CLEW_DOMAIN_ID in the environment"};
  }
  CLEW_RETURN_IF_ERROR(bridge::check_domain(domain));
  return domain;
}

/// Robots of ROS 2 are known here, and not where components run.
bridge::RobotMaker meet_robots(bridge::RobotHost host) {
  const auto robots = std::make_shared<robot::Robots>(
      std::move(host.run_id), host.domain, std::move(host.on_notice), std::move(host.on_fatal));
  return {[robots](const runtime::RunPlan& plan, const runtime::GraphStage& stage) {
            return robots->make_node(plan, stage);
          },
          [robots] { robots->stand_still(); }};
}

int component_command(const ComponentOptions& options) {
  if (options.graph != "-") {
    if (const auto checked = check_graph(options); !checked.ok()) return complain(checked.error());
  }
  const auto domain = read_domain(options);
  if (!domain.ok()) return complain(domain.error());
  bridge::RunPlace place{*domain, kConnectTimeout_s, options.line, {}};
  if (options.line) {
    place.allowed = options.allowed;
    // It is for this process alone, not for programs that it starts.
    if (::fcntl(*options.line, F_SETFD, FD_CLOEXEC) != 0) {
      return complain(Error{std::strerror(errno), "--line"});
    }
  }
  return bridge::run_component_process(options.stage, place, stages::all(), meet_robots);
}

}  // namespace

void add_component(CLI::App& main, int& status) {
  const auto options = std::make_shared<ComponentOptions>();
  CLI::App* app =
      main.add_subcommand("component", "Run a stage of a run, or a group of them, as this process");
  app->add_option("graph", options->graph, "a name or a path; -: as the run has it")->required();
  app->add_option("stage", options->stage, "sense, classify, ..., or a group of stages")
      ->required();
  app->add_option("--domain", options->domain, "the run's DDS domain (CLEW_DOMAIN_ID)");
  app->add_option("--line", options->line, "a connected line")->group("");
  app->add_option("--allow", options->allowed, "a program or plug-in")
      ->allow_extra_args(false)
      ->group("");
  app->callback([options, &status] { status = component_command(*options); });
}

void add_recorder(CLI::App& main, int& status) {
  const auto domain = std::make_shared<int>(0);
  CLI::App* app = main.add_subcommand("recorder", "Record a run as this process");
  app->group("");
  app->add_option("--domain", *domain, "the run's DDS domain")->required();
  app->callback(
      [domain, &status] { status = bridge::run_recorder_process(*domain, kConnectTimeout_s); });
}

}  // namespace clew::tools

// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>
#include <string>

#include "clew/commands.hpp"
#include "dds/participant.hpp"
#include "process/component_process.hpp"
#include "process/recorder_process.hpp"
#include "runtime/run_plan.hpp"
#include "stages/all.hpp"

namespace clew::tools {
namespace {

// A person may start the component first and the run afterwards.
constexpr double kConnectTimeout_s = 60.0;

}  // namespace

int component_command(const ComponentOptions& options) {
  if (options.graph != "-") {
    // The run decides the configuration; a graph that is named must at least be one with the stage.
    const auto plan = runtime::prepare_run(options.graph, {},
                                           runtime::ConfigPath::from_environment(), stages::all());
    if (!plan.ok()) return complain(plan.error());
    if (plan->graph.find(options.stage) == nullptr) {
      return complain(
          {"graph '" + options.graph + "' has no stage '" + options.stage + "'", {}, 0, 0});
    }
  }
  int domain = -1;
  if (options.domain) {
    domain = *options.domain;
  } else if (const char* text = std::getenv("CLEW_DOMAIN_ID")) {
    domain = std::atoi(text);
  } else {
    return complain({"which run? give --domain, or CLEW_DOMAIN_ID in the environment", {}, 0, 0});
  }
  if (const auto checked = bridge::check_domain(domain); !checked.ok()) {
    return complain(checked.error());
  }
  return bridge::run_component_process(options.stage, domain, kConnectTimeout_s, stages::all());
}

int recorder_command(const RecorderOptions& options) {
  return bridge::run_recorder_process(options.domain, kConnectTimeout_s);
}

}  // namespace clew::tools

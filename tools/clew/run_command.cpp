// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <set>

#include "clew/commands.hpp"
#include "clew/own_program.hpp"
#include "clew/run_output.hpp"
#include "core/nearest_name.hpp"
#include "process/composed_run.hpp"
#include "process/recording_sink.hpp"
#include "process/run_members.hpp"
#include "process/supervisor.hpp"
#include "stages/all.hpp"

namespace clew::tools {
namespace {

using core::Error;
using core::Result;

const std::vector<std::string> kVendors = {"cyclonedds", "fastdds"};

struct Speed {
  bridge::Pace pace = bridge::Pace::kLockstep;
  double factor = 1.0;
};

Result<Speed> read_pace(const std::string& text) {
  if (text == "lockstep") return Speed{};
  if (text == "realtime") return Speed{bridge::Pace::kRealtime, 1.0};
  double factor = 0.0;
  char unit = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%lf%c%c", &factor, &unit, &rest) == 2 && unit == 'x' &&
      std::isfinite(factor) && factor >= 0.001 && factor <= 1000.0) {
    return Speed{bridge::Pace::kScaled, factor};
  }
  return Error{"found '" + text + "'; allowed: lockstep, realtime, or a factor of simulated time " +
                   "from 0.001x to 1000x",
               "--pace", 0, 0};
}

Result<void> check_stage(const runtime::Graph& graph, const std::string& stage,
                         const char* option) {
  if (graph.find(stage) != nullptr) return {};
  std::vector<std::string> known;
  for (const auto& candidate : graph.stages) known.push_back(candidate.info->name);
  return Error{core::unknown_name("stage of this graph", stage, known), option, 0, 0};
}

Result<void> read_middleware(const RunOptions& options, const runtime::Graph& graph,
                             bridge::ProcessLayout& layout) {
  for (const std::string& text : options.middleware) {
    const std::size_t equals = text.find('=');
    const std::string vendor = equals == std::string::npos ? text : text.substr(equals + 1);
    if (vendor != kVendors[0] && vendor != kVendors[1]) {
      return Error{core::unknown_name("middleware", vendor, kVendors), "--middleware", 0, 0};
    }
    if (equals == std::string::npos) {
      // The command line outranks the graph.
      layout.middleware = vendor;
      for (const auto& stage : graph.stages)
        layout.stage_middleware.emplace(stage.info->name, vendor);
    } else {
      const std::string stage = text.substr(0, equals);
      CLEW_RETURN_IF_ERROR(check_stage(graph, stage, "--middleware"));
      layout.stage_middleware[stage] = vendor;
    }
  }
  return {};
}

Result<bridge::ProcessLayout> read_layout(const RunOptions& options, const runtime::Graph& graph,
                                          const Speed& speed) {
  bridge::ProcessLayout layout;
  layout.program = own_program();
  layout.domain = options.domain;
  layout.pace = speed.pace;
  layout.pace_factor = speed.factor;
  layout.hash = !options.no_hash;
  CLEW_RETURN_IF_ERROR(read_middleware(options, graph, layout));
  for (const std::string& stage : options.external) {
    CLEW_RETURN_IF_ERROR(check_stage(graph, stage, "--external"));
    layout.external.insert(stage);
  }
  for (const std::string& text : options.prefix) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals + 1 == text.size()) {
      return Error{"expected STAGE='command', found '" + text + "'", "--prefix", 0, 0};
    }
    CLEW_RETURN_IF_ERROR(check_stage(graph, text.substr(0, equals), "--prefix"));
    layout.prefix[text.substr(0, equals)] = text.substr(equals + 1);
  }
  return layout;
}

// One vendor's name, or each stage with its own.
std::string middleware_text(const runtime::Graph& graph, const bridge::ProcessLayout& layout) {
  std::set<std::string> vendors;
  std::string each;
  for (const auto& stage : graph.stages) {
    const std::string vendor = bridge::middleware_of(stage, layout);
    vendors.insert(vendor);
    each += (each.empty() ? "" : ",") + stage.info->name + '=' + vendor;
  }
  return vendors.size() == 1 ? *vendors.begin() : each;
}

Result<void> check_options(const RunOptions& options) {
  if (options.layout != "processes" && options.layout != "composed") {
    return Error{core::unknown_name("layout", options.layout, {"processes", "composed"}),
                 "--layout", 0, 0};
  }
  const bool composed = options.layout == "composed";
  if (composed && (!options.external.empty() || !options.prefix.empty() || options.domain ||
                   !options.middleware.empty())) {
    return Error{
        "--external, --prefix, --domain and --middleware need --layout processes", {}, 0, 0};
  }
  if (options.domain && (*options.domain < 0 || *options.domain > 99)) {
    return Error{fmt::format("found {}; allowed: 0 to 99", *options.domain), "--domain", 0, 0};
  }
  return {};
}

}  // namespace

int run_command(const RunOptions& options) {
  if (const auto checked = check_options(options); !checked.ok()) return complain(checked.error());
  const auto speed = read_pace(options.pace);
  if (!speed.ok()) return complain(speed.error());
  const auto plan = runtime::prepare_run(options.graph, options.overrides,
                                         runtime::ConfigPath::from_environment(), stages::all());
  if (!plan.ok()) return complain(plan.error());
  const auto layout = read_layout(options, plan->graph, *speed);
  if (!layout.ok()) return complain(layout.error());
  std::unique_ptr<bridge::RecordingSink> recording;
  if (!options.record.empty()) {
    auto created = bridge::RecordingSink::create(*plan, options.record, options.force);
    if (!created.ok()) return complain(created.error());
    recording = std::move(created).value();
  }

  const auto display = terminal_display(*plan);
  const bool composed = options.layout == "composed";
  auto report = composed ? bridge::run_composed(*plan, {speed->pace, speed->factor, layout->hash},
                                                recording.get(), display)
                         : bridge::run_processes(*plan, *layout, recording.get(), display);
  clear_display();
  if (!report.ok()) return complain(report.error());
  if (recording) {
    const auto closed = recording->close();
    if (!closed.ok() && report->aborted.empty()) report->aborted = closed.error().text();
  }
  if (!report->aborted.empty()) std::fprintf(stderr, "clew: %s\n", report->aborted.c_str());
  const RunFacts facts{options.layout,
                       composed ? "inprocess" : middleware_text(plan->graph, *layout),
                       options.record};
  std::puts(options.json ? report_json(*report, *plan, facts).c_str()
                         : report_line(*report, *plan).c_str());
  return exit_status(*report);
}

}  // namespace clew::tools

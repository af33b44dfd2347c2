// SPDX-License-Identifier: Apache-2.0
#include "clew/run_layout.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <set>

#include "clew/foreign_programs.hpp"
#include "clew/own_program.hpp"
#include "core/nearest_name.hpp"
#include "runtime/middleware.hpp"
#include "supervisor/launcher.hpp"

namespace clew::tools {

using core::Error;
using core::Result;

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
               "--pace"};
}

namespace {

Result<void> check_stage(const runtime::Graph& graph, const std::string& stage,
                         const char* option) {
  if (graph.find(stage) != nullptr) return {};
  std::vector<std::string> known;
  for (const auto& candidate : graph.stages) known.push_back(candidate.info->name);
  return Error{core::unknown_name("stage of this graph", stage, known), option};
}

Error given_twice(const char* option, const std::string& what) {
  return {"is given twice" + (what.empty() ? "" : " for " + what) + "; once is allowed", option};
}

Result<void> read_middleware(const RunOptions& options, const runtime::Graph& graph,
                             bridge::ProcessLayout& layout) {
  std::set<std::string> given;
  for (const std::string& text : options.middleware) {
    const std::size_t equals = text.find('=');
    const std::string vendor = equals == std::string::npos ? text : text.substr(equals + 1);
    if (!runtime::is_middleware(vendor)) {
      return Error{runtime::unknown_middleware(vendor), "--middleware"};
    }
    const std::string stage = equals == std::string::npos ? "" : text.substr(0, equals);
    if (!given.insert(stage).second) return given_twice("--middleware", stage);
    if (equals == std::string::npos) {
      // The command line outranks the graph.
      layout.middleware = vendor;
      for (const auto& each : graph.stages) {
        layout.stage_middleware.emplace(each.info->name, vendor);
      }
    } else {
      CLEW_RETURN_IF_ERROR(check_stage(graph, stage, "--middleware"));
      layout.stage_middleware[stage] = vendor;
    }
  }
  return {};
}

/// The command line may give a stage of a group another middleware than the others have.
Result<void> check_group_middleware(const runtime::Graph& graph,
                                    const bridge::ProcessLayout& layout) {
  std::map<std::string, const runtime::GraphStage*> first_of;
  for (const auto& stage : graph.stages) {
    const auto& first = *first_of.emplace(bridge::process_of(stage), &stage).first->second;
    const std::string one = bridge::middleware_of(first, layout);
    const std::string other = bridge::middleware_of(stage, layout);
    if (one == other) continue;
    return Error{"the stages of group '" + stage.deployment.group +
                     "' share a process, and so one middleware; found " + one + " in " +
                     first.info->name + " and " + other + " in " + stage.info->name,
                 "--middleware"};
  }
  return {};
}

Result<void> read_prefixes(const RunOptions& options, const runtime::Graph& graph,
                           bridge::ProcessLayout& layout) {
  std::map<std::string, std::string> stage_of;  // by process, which has one command line
  for (const std::string& text : options.prefix) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals + 1 == text.size()) {
      return Error{"expected STAGE='command', found '" + text + "'", "--prefix"};
    }
    const std::string stage = text.substr(0, equals);
    CLEW_RETURN_IF_ERROR(check_stage(graph, stage, "--prefix"));
    const auto [other, first] = stage_of.emplace(bridge::process_of(*graph.find(stage)), stage);
    if (!first) {
      return given_twice("--prefix", other->second == stage ? stage : "the process of " + stage);
    }
    const std::string command = text.substr(equals + 1);
    CLEW_RETURN_IF_ERROR(check_prefix(command));
    layout.prefix.emplace(stage, command);
  }
  return {};
}

}  // namespace

Result<bridge::ProcessLayout> read_layout(const RunOptions& options, const runtime::Graph& graph,
                                          const Speed& speed) {
  bridge::ProcessLayout layout;
  layout.program = own_program();
  layout.domain = options.domain;
  layout.name = options.name;
  // The page of a run finds it by its name.
  if (options.view && layout.name.empty()) layout.name = fmt::format("view-{}", ::getpid());
  // So does its bridge.
  if (!options.ros2.empty() && layout.name.empty())
    layout.name = fmt::format("ros2-{}", ::getpid());
  layout.pace = speed.pace;
  layout.pace_factor = speed.factor;
  layout.realtime_priority = options.realtime_priority.value_or(0);
  if (!options.secure.empty()) {
    layout.security = options.secure == runtime::kMintedKeys ? "" : options.secure;
  }
  layout.hash = !options.no_hash;
  layout.on_record_error = options.on_record_error == "stop" ? bridge::OnRecordError::kStop
                                                             : bridge::OnRecordError::kContinue;
  CLEW_RETURN_IF_ERROR(read_middleware(options, graph, layout));
  CLEW_RETURN_IF_ERROR(check_group_middleware(graph, layout));
  for (const std::string& stage : options.external) {
    CLEW_RETURN_IF_ERROR(check_stage(graph, stage, "--external"));
    if (!layout.external.insert(stage).second) return given_twice("--external", stage);
  }
  CLEW_RETURN_IF_ERROR(read_prefixes(options, graph, layout));
  return layout;
}

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

}  // namespace clew::tools

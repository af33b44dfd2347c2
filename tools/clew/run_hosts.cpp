// SPDX-License-Identifier: Apache-2.0
#include "clew/run_hosts.hpp"

#include <algorithm>
#include <ctime>
#include <map>
#include <string>
#include <vector>

#include "core/nearest_name.hpp"
#include "hosts/host_identity.hpp"
#include "hosts/host_list.hpp"
#include "hosts/relay.hpp"
#include "supervisor/launcher.hpp"

namespace clew::tools {
namespace {

using core::Error;
using core::Result;
using runtime::GraphStage;

/// What --host says for a stage that the graph has put elsewhere.
constexpr char kHere[] = "here";
constexpr char kNoFallback[] = "none";

using HostOf = std::map<std::string, std::string>;  // by stage

Result<HostOf> read_options(const RunOptions& options, const runtime::Graph& graph) {
  HostOf host_of;
  std::vector<std::string> stages;
  for (const GraphStage& stage : graph.stages) stages.push_back(stage.info->name);
  for (const std::string& text : options.host) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals + 1 == text.size()) {
      return Error{"expected STAGE=NAME, found '" + text + "'", "--host"};
    }
    const std::string stage = text.substr(0, equals);
    if (graph.find(stage) == nullptr) {
      return Error{core::unknown_name("stage of this graph", stage, stages), "--host"};
    }
    if (!host_of.emplace(stage, text.substr(equals + 1)).second) {
      return Error{"is given twice for " + stage + "; once is allowed", "--host"};
    }
  }
  return host_of;
}

/// Those that are elsewhere, with the graph's word where the options have none.
Result<HostOf> hosts_of(const RunOptions& options, const runtime::Graph& graph) {
  auto given = read_options(options, graph);
  if (!given.ok()) return given;
  HostOf host_of;
  std::map<std::string, const GraphStage*> first_of;  // by process
  for (const GraphStage& stage : graph.stages) {
    const std::string& name = stage.info->name;
    const auto option = given->find(name);
    std::string host = option != given->end() ? option->second : stage.deployment.host;
    if (host == kHere) host.clear();
    if (!host.empty()) host_of[name] = host;
    const GraphStage& first = *first_of.emplace(bridge::process_of(stage), &stage).first->second;
    const std::string of_first =
        host_of.count(first.info->name) > 0 ? host_of[first.info->name] : "";
    if (of_first == host) continue;
    return Error{"the stages of group '" + stage.deployment.group +
                     "' share a process, and so one host; found " +
                     (of_first.empty() ? kHere : of_first) + " in " + first.info->name + " and " +
                     (host.empty() ? kHere : host) + " in " + name,
                 "--host"};
  }
  return host_of;
}

Result<void> check_stage(const std::string& stage, const runtime::Graph& graph,
                         const bridge::ProcessLayout& layout) {
  const std::string where = stage + " is on another host, and ";
  if (bridge::is_third_party(*graph.find(stage))) {
    return Error{where +
                 "a program that speaks DDS itself is not started there; start it there "
                 "yourself, or use one that speaks JSON lines"};
  }
  if (layout.external.count(stage) > 0) return Error{where + "nobody starts it here", "--external"};
  if (layout.prefix.count(stage) > 0) {
    return Error{where + "starts under no command", "--prefix"};
  }
  return {};
}

Result<void> check_fallback(const std::string& fallback, const bridge::HostList& list) {
  if (list.hosts.count(fallback) > 0) return {};
  std::vector<std::string> allowed = {kNoFallback, bridge::kFallbackHere};
  for (const auto& [name, address] : list.hosts) allowed.push_back(name);
  return Error{core::unknown_name("choice", fallback, allowed), "--fallback"};
}

}  // namespace

Result<void> read_hosts(const RunOptions& options, const runtime::Graph& graph,
                        bridge::ProcessLayout& layout) {
  const bool falls_back = options.fallback != kNoFallback;
  auto host_of = hosts_of(options, graph);
  if (!host_of.ok()) return host_of.error();
  if (host_of->empty()) {
    if (falls_back) return Error{"no stage is on a host", "--fallback"};
    if (options.hosts.empty()) return {};
    return Error{"no stage is on a host; see --host, or 'process: {host: NAME}' of the graph",
                 "--hosts"};
  }
  const auto& [stage, host] = *host_of->begin();
  if (options.hosts.empty()) {
    return Error{stage + " is to run on host '" + host +
                 "'; which address has it? Give --hosts FILE"
                 ", or --host " +
                 stage + "=" + kHere};
  }
  const auto list = bridge::HostList::read(options.hosts);
  if (!list.ok()) return list.error();
  std::vector<std::string> used;
  if (falls_back && options.fallback != bridge::kFallbackHere) {
    CLEW_RETURN_IF_ERROR(check_fallback(options.fallback, *list));
    used.push_back(options.fallback);
  }
  for (const auto& [name, where] : *host_of) {
    CLEW_RETURN_IF_ERROR(check_stage(name, graph, layout));
    const auto found = list->find(where);
    if (!found.ok()) return Error{name + ": " + found.error().message, options.hosts};
    used.push_back(where);
  }
  const auto identity =
      bridge::HostIdentity::read(list->identity, bridge::HostRole::kRunner, std::time(nullptr));
  if (!identity.ok()) return identity.error();
  auto addresses = list->addresses(used);
  if (!addresses.ok()) return addresses.error();
  layout.hosts =
      bridge::HostsLayout{options.hosts, std::move(host_of).value(), std::move(addresses).value(),
                          falls_back ? options.fallback : std::string()};
  return {};
}

}  // namespace clew::tools

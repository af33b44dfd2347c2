// SPDX-License-Identifier: Apache-2.0
#include "supervisor/launcher.hpp"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <set>
#include <utility>

#include "component/json_lines.hpp"
#include "core/quoted.hpp"
#include "plugins/plugin_loader.hpp"
#include "run/limits.hpp"
#include "supervisor/run_participants.hpp"
#include "vendors/network_addresses.hpp"
#include "wire/codec.hpp"

namespace clew::bridge {
namespace {

using runtime::Graph;
using runtime::GraphStage;
using runtime::Topic;

// The run has the graph, so the line does not depend on where it is typed.
std::string component_line(const std::string& program, const std::string& stage, int domain) {
  return core::shell_word(program) + " component - " + stage + " --domain " +
         std::to_string(domain);
}

std::vector<ExpectedEndpoint> expected_endpoints(const Graph& graph, const GraphStage& stage) {
  std::vector<ExpectedEndpoint> expected;
  for (Topic topic : domain::kAllTopics) {
    const auto index = index_of(topic);
    const std::string name(domain::topic_name(topic));
    if (stage.ports.outputs[index]) {
      for (const GraphStage* reader : graph.readers_of(topic)) {
        expected.push_back({name, false, reader->info->name, is_third_party(*reader)});
      }
    }
    if (stage.ports.all_inputs()[index]) {
      const GraphStage* writer = graph.writer_of(topic);
      expected.push_back({name, true, writer->info->name, is_third_party(*writer)});
    }
  }
  return expected;
}

/// The child through which a member's process on another host is as if it were here.
std::vector<std::string> relay_command(const Member& member, const ProcessLayout& layout,
                                       int domain) {
  std::vector<std::string> words = {layout.program, "relay",    layout.hosts->file,    member.host,
                                    member.stage,   "--domain", std::to_string(domain)};
  if (!layout.hosts->fallback.empty()) {
    words.insert(words.end(), {"--fallback", layout.hosts->fallback});
  }
  return words;
}

/// Adds the name of the participant with that endpoint, if it is one of ours in another process.
void add_peer(const Graph& graph, const ExpectedEndpoint& endpoint,
              const std::vector<std::string>& own, std::vector<std::string>& peers) {
  if (endpoint.third_party || std::count(own.begin(), own.end(), endpoint.stage) > 0) return;
  std::string process = process_of(*graph.find(endpoint.stage));
  if (std::count(peers.begin(), peers.end(), process) == 0) peers.push_back(std::move(process));
}

/// Whether every stage but the robot has a part in the inputs of a command. Then nobody gets more
/// than a tick ahead of another, as long as the robot waits for its commands.
bool command_waits_for_all(const Graph& graph) {
  std::set<const GraphStage*> waited_for;
  std::vector<const GraphStage*> open = {graph.writer_of(Topic::kCommand)};
  while (!open.empty()) {
    const GraphStage* stage = open.back();
    open.pop_back();
    if (stage == nullptr || !waited_for.insert(stage).second) continue;
    for (Topic topic : domain::kAllTopics) {
      if (stage->ports.inputs[index_of(topic)]) open.push_back(graph.writer_of(topic));
    }
  }
  return std::all_of(graph.stages.begin(), graph.stages.end(), [&](const GraphStage& stage) {
    return stage.ports.delayed_inputs.any() || waited_for.count(&stage) > 0;
  });
}

}  // namespace

runtime::Bundle bundle_for(const runtime::RunPlan& plan, const GraphStage& stage) {
  runtime::Bundle bundle = plan.bundle;
  if (!stage.info->knows_world) bundle.erase("world.yaml");
  return bundle;
}

void fill_assignment(const runtime::RunPlan& plan, const ProcessLayout& layout,
                     const std::vector<std::string>& stages, Assignment& assignment) {
  assignment.stages = stages;
  for (const std::string& stage : stages) {
    const GraphStage& found = *plan.graph.find(stage);
    // What one of them may know, their process is told.
    if (assignment.bundle.empty() || found.info->knows_world) {
      assignment.bundle = bundle_for(plan, found);
    }
    for (ExpectedEndpoint& endpoint : expected_endpoints(plan.graph, found)) {
      add_peer(plan.graph, endpoint, stages, assignment.peers);
      assignment.expected.push_back(std::move(endpoint));
    }
  }
  // What the user has named for the run holds for its processes; recordings do not carry it.
  assignment.bundle[kPluginLines] = plugin_lines();
  assignment.pace = layout.pace;
  assignment.pace_factor = layout.pace_factor;
  assignment.realtime_priority = layout.realtime_priority;
  assignment.hash = layout.hash;
  // Nobody tells a third-party drive when all are there.
  const GraphStage* robot = plan.graph.writer_of(Topic::kState);
  assignment.waits_for_go = robot != nullptr && is_third_party(*robot);
  // Such a drive is given no credit. In real time, who is that late is killed.
  assignment.has_lead = !assignment.waits_for_go || command_waits_for_all(plan.graph);
}

std::string middleware_of(const GraphStage& stage, const ProcessLayout& layout) {
  const auto chosen = layout.stage_middleware.find(stage.info->name);
  if (chosen != layout.stage_middleware.end()) return chosen->second;
  return stage.deployment.middleware.empty() ? layout.middleware : stage.deployment.middleware;
}

std::string host_of(const GraphStage& stage, const ProcessLayout& layout) {
  if (!layout.hosts) return {};
  const auto found = layout.hosts->host.find(stage.info->name);
  return found == layout.hosts->host.end() ? std::string() : found->second;
}

bool speaks_to_robot(const Member& member, const Graph& graph) {
  return std::any_of(member.stages.begin(), member.stages.end(), [&](const std::string& stage) {
    return graph.find(stage)->deployment.ros2.has_value();
  });
}

ChildCommand command_of(const Member& member, const runtime::RunPlan& plan,
                        const ProcessLayout& layout, const ThirdPartyEnvironment& environment) {
  const GraphStage& stage = *plan.graph.find(member.stages.front());
  ChildCommand command;
  command.environment = environment.variables();
  command.may_start_others = !stage.deployment.exec.empty();
  if (member.third_party) {
    command.arguments = stage.deployment.exec;
    command.environment.merge(facts_for_program(plan, stage));
  } else {
    const auto other = layout.stage_program.find(stage.info->name);
    const bool is_other = other != layout.stage_program.end();
    command.arguments = {is_other ? other->second : layout.program, "component", "-", member.stage};
  }
  if (!member.host.empty()) {
    command.arguments = relay_command(member, layout, environment.domain());
  }
  for (const std::string& each : member.stages) {
    const auto prefix = layout.prefix.find(each);
    if (prefix == layout.prefix.end()) continue;
    // The shell knows how to take a command line apart; it is replaced by the program at once.
    const std::vector<std::string> shell = {"/bin/sh", "-c", "exec " + prefix->second + " \"$@\"",
                                            "sh"};
    command.arguments.insert(command.arguments.begin(), shell.begin(), shell.end());
    command.keeps_terminal = true;
  }
  command.brings_to_rest = (member.starts_ticks || speaks_to_robot(member, plan.graph)) &&
                           !member.third_party && layout.pace == Pace::kRealtime;
  return command;
}

std::string how_to_start(const runtime::RunPlan& plan, const GraphStage& stage,
                         const std::string& program, int domain,
                         const ThirdPartyEnvironment& environment) {
  std::string command;
  if (is_third_party(stage)) {
    command = "env";
    auto variables = environment.variables();
    variables.merge(facts_for_program(plan, stage));
    for (const auto& [name, value] : variables) {
      command += ' ' + name + '=' + core::shell_word(value);
    }
    for (const std::string& word : stage.deployment.exec) command += ' ' + core::shell_word(word);
  } else {
    command = component_line(program, process_of(stage), domain);
  }
  return "waiting for " + process_of(stage) + "; start it with: " + command;
}

Launcher::Launcher(const runtime::RunPlan& plan, const ProcessLayout& layout, int domain,
                   Spooling spooling, StartProcess start, RunSecurity::Shared security)
    : plan_(plan),
      layout_(layout),
      domain_(domain),
      spooling_(spooling),
      start_(std::move(start)),
      run_id_(std::to_string(::getpid()) + '-' + std::to_string(domain)),
      run_key_(RunKey::make()),
      security_(std::move(security)),
      environment_(domain, patience().lease_s, run_id_, {}, network()) {
  if (security_ == nullptr) return;
  for (const GraphStage& stage : plan.graph.stages) {
    if (!is_third_party(stage)) continue;
    const std::string& name = stage.info->name;
    const ThirdPartyIdentity identity{security_->files(name, Vendor::kCycloneDds),
                                      security_->files(name, Vendor::kFastDds)};
    secured_environments_.try_emplace(name, domain, patience().lease_s, run_id_, identity,
                                      network());
  }
}

// Whether one of them is of this host was checked before.
std::optional<NetworkAddresses> Launcher::network() const {
  if (!layout_.hosts) return std::nullopt;
  const auto found = network_of(layout_.hosts->addresses);
  return found.ok() ? *found : std::nullopt;
}

const ThirdPartyEnvironment& Launcher::environment_of(const Member& member) const {
  const auto found = secured_environments_.find(member.stage);
  return found != secured_environments_.end() ? found->second : environment_;
}

std::optional<SecurityFiles> Launcher::security_of(const std::string& name,
                                                   const std::string& middleware) const {
  if (security_ == nullptr) return std::nullopt;
  return security_->files(name, vendor_from_name(middleware).value());
}

void Launcher::spool() {
  if (spooling_ == Spooling::kNothing) spooling_ = Spooling::kSamples;
}

core::Result<void> Launcher::start(Member& member) const {
  const ThirdPartyEnvironment& environment = environment_of(member);
  if (member.third_party && !environment.failure().empty()) {
    return core::Error{member.stage + ": " + environment.failure()};
  }
  auto child = start_(command_of(member, plan_, layout_, environment));
  if (!child.ok()) return core::Error{member.stage + ": " + child.error().text()};
  member.child = std::move(child).value();
  member.down = false;
  member.left_at.reset();
  return {};
}

ChildCommand Launcher::recorder_command() const {
  ChildCommand command;
  command.arguments = {layout_.program, "recorder", "--domain", std::to_string(domain_)};
  return command;
}

std::string Launcher::how_to_start(const Member& member) const {
  return bridge::how_to_start(plan_, *plan_.graph.find(member.stages.front()), layout_.program,
                              domain_, environment_of(member));
}

core::Result<Member*> Launcher::admit(const Hello& hello, std::vector<Member>& members) const {
  Member* const member = find_member(members, hello.stage);
  if (member == nullptr || member->third_party || member->link || member->left_at) return nullptr;
  if (hello.idl_fingerprint == idl_fingerprint()) return member;
  return core::Error{hello.stage + " (process " + std::to_string(hello.process_id) +
                     ") was built from other IDL files: its fingerprint is " +
                     hello.idl_fingerprint + ", that of the run is " +
                     std::string(idl_fingerprint())};
}

Assignment Launcher::assignment_for(const std::vector<std::string>& stages,
                                    const std::string& middleware) const {
  Assignment assignment;
  assignment.run_id = run_id_;
  assignment.run_key = run_key_.secret();
  assignment.middleware = middleware;
  assignment.domain = domain_;
  assignment.lease_s = patient() ? kPatientLease_s : patience().lease_s;
  assignment.spooling = spooling_;
  assignment.history_depth = kHistoryDepth;
  assignment.lead = kLead;
  if (layout_.hosts) assignment.hosts = layout_.hosts->addresses;
  fill_assignment(plan_, layout_, stages, assignment);
  return assignment;
}

Assignment Launcher::assignment_for(const Member& member) const {
  const std::string middleware = middleware_of(*plan_.graph.find(member.stages.front()), layout_);
  Assignment assignment = assignment_for(member.stages, middleware);
  assignment.security = security_of(member.stage, middleware);
  if (!member.checkpoints.empty()) assignment.checkpoint = member.checkpoints.back();
  return assignment;
}

Assignment Launcher::assignment_for_observer() const {
  Assignment assignment = assignment_for({}, layout_.middleware);
  assignment.security = security_of(kObserverIdentity, layout_.middleware);
  return assignment;
}

Assignment Launcher::assignment_for_watcher() const {
  Assignment assignment;
  assignment.run_id = run_id_;
  assignment.bundle = plan_.bundle;
  assignment.middleware = layout_.middleware;
  assignment.security = security_of(kWatcherName, layout_.middleware);
  assignment.domain = domain_;
  assignment.pace = layout_.pace;
  assignment.pace_factor = layout_.pace_factor;
  assignment.history_depth = kHistoryDepth;
  if (layout_.hosts) assignment.hosts = layout_.hosts->addresses;
  return assignment;
}

std::chrono::steady_clock::duration Launcher::start_timeout() const {
  if (patient()) return kPatienceOfPerson;
  return std::chrono::duration_cast<std::chrono::steady_clock::duration>(
      std::chrono::duration<double>(patience().start * plan_.graph.start_timeout_s));
}

}  // namespace clew::bridge

// SPDX-License-Identifier: Apache-2.0
#include "process/muster.hpp"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <utility>

#include "convert/codec.hpp"

namespace clew::bridge {
namespace {

constexpr auto kPatience = std::chrono::hours(1);
constexpr double kPatientLease_s = 3600.0;

/// The word as a shell takes it for one.
std::string for_shell(const std::string& word) {
  const bool plain = std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || std::strchr("_-./=:,@%+", c) != nullptr;
  });
  if (plain && !word.empty()) return word;
  std::string quoted = "'";
  for (const char c : word) c == '\'' ? quoted += "'\\''" : quoted += c;
  return quoted + '\'';
}

}  // namespace

// The run has the graph, so the line does not depend on where it is typed.
std::string component_line(const std::string& program, const std::string& stage, int domain) {
  return for_shell(program) + " component - " + stage + " --domain " + std::to_string(domain);
}

Muster::Muster(const runtime::RunPlan& plan, const ProcessLayout& layout, int domain,
               Spooling spooling)
    : plan_(plan),
      layout_(layout),
      domain_(domain),
      spooling_(spooling),
      run_id_(std::to_string(::getpid()) + '-' + std::to_string(domain)) {}

core::Result<void> Muster::start(Member& member) const {
  auto child = ChildProcess::start(
      command_of(member, *plan_.graph.find(member.stage), layout_, domain_, run_id_));
  if (!child.ok()) return core::Error{member.stage + ": " + child.error().text(), {}, 0, 0};
  member.child = std::move(child).value();
  member.down = false;
  return {};
}

ChildCommand Muster::recorder_command() const {
  ChildCommand command;
  command.arguments = {layout_.program, "recorder", "--domain", std::to_string(domain_)};
  return command;
}

std::string Muster::how_to_start(const Member& member) const {
  std::string command = component_line(layout_.program, member.stage, domain_);
  if (member.foreign) {
    command = "env";
    for (const auto& [name, value] : environment_of(domain_, run_id_)) {
      command += ' ' + name + '=' + for_shell(value);
    }
    for (const std::string& word : plan_.graph.find(member.stage)->deployment.exec) {
      command += ' ' + for_shell(word);
    }
  }
  return "waiting for " + member.stage + "; start it with: " + command;
}

core::Result<Member*> Muster::admit(const Hello& hello, std::vector<Member>& members) const {
  const auto member = std::find_if(members.begin(), members.end(), [&](const Member& candidate) {
    return candidate.stage == hello.stage && !candidate.foreign;
  });
  if (member == members.end() || member->link != nullptr) return nullptr;
  if (hello.idl_fingerprint == idl_fingerprint()) return &*member;
  return core::Error{hello.stage + " (process " + std::to_string(hello.process_id) +
                         ") was built from other IDL files: its fingerprint is " +
                         hello.idl_fingerprint + ", that of the run is " +
                         std::string(idl_fingerprint()),
                     {},
                     0,
                     0};
}

Assignment Muster::assignment_for(const std::string& stage, const std::string& middleware) const {
  Assignment assignment;
  assignment.run_id = run_id_;
  assignment.middleware = middleware;
  assignment.domain = domain_;
  if (patient()) assignment.lease_s = kPatientLease_s;
  assignment.spooling = spooling_;
  assignment.history_depth = kHistoryDepth;
  assignment.lead = kLead;
  fill_assignment(plan_, layout_, stage, assignment);
  return assignment;
}

Assignment Muster::assignment_for(const Member& member) const {
  Assignment assignment =
      assignment_for(member.stage, middleware_of(*plan_.graph.find(member.stage), layout_));
  if (!member.checkpoints.empty()) assignment.checkpoint = member.checkpoints.back();
  return assignment;
}

std::chrono::steady_clock::duration Muster::start_timeout() const {
  if (patient()) return kPatience;
  return std::chrono::duration_cast<std::chrono::steady_clock::duration>(
      std::chrono::duration<double>(plan_.graph.start_timeout_s));
}

}  // namespace clew::bridge
